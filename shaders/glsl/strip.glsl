// How a convex polygon becomes triangles.

// The rank of vertex `index` of the triangle strip that fills a convex polygon of n vertices:
// 0, 1, n - 1, 2, n - 2, ...
int rankInStrip(int index, int n) {
    int half_way = (index + 1) / 2;
    return index == 0 ? 0 : (index % 2 == 1 ? half_way : n - half_way);
}
