// The bin, of `count` in a row, in which a place lies that is `at` bins away from the first one's beginning;
// the outermost where it lies in none. A real need not hold count - 1, hence the last minimum.
cell_int binAlong(real at, int count) {
    return min(cell_int(min(max(at, real(0.0)), real(count))), cell_int(count - 1));
}
