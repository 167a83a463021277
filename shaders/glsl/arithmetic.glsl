// What the device makes of four numbers: plain expressions, each as a shader of ours has them. The twin of
// Computed in src/backend/backend.h; src/session/arithmetic.cpp knows what they should be.
struct Computed {
    vec4 first;
    vec4 second;
};

Computed computed(vec4 n) {
    // Compilers may fuse this product and this sum into one rounding,
    float product_sum = n.x * n.y + n.z;
    // and must neither do so here nor rearrange sums, on which sites.glsl relies.
    precise float rounded_twice = n.x * n.y + n.z;
    precise float offset = (n.x - n.y) + (n.z - n.w);
    return Computed(vec4(n.x / n.y, sqrt(abs(n.x)), inversesqrt(abs(n.x)), n.x * n.y),
                    vec4(n.x + n.y, product_sum, rounded_twice, offset));
}
