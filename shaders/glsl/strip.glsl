// How a convex polygon becomes triangles.

// The rank of the vertex at a place of the triangle strip that fills a convex polygon of n
// vertices: 0, 1, n - 1, 2, n - 2, ...
int rankInStrip(int place, int n) {
    int half_way = (place + 1) / 2;
    return place == 0 ? 0 : (place % 2 == 1 ? half_way : n - half_way);
}
