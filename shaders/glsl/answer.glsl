// What edges.geom and neighbors.comp answer for an entry. Its includer has included site_entry.glsl or
// list_entry.glsl.

#ifdef WEIGHTED
#define ROW_PARTS (MAX_EDGES / 4 + 1)
#else
#define ROW_PARTS (MAX_EDGES / 4)
#endif

struct Answer {
    int word;              // the status, and above its eight bits how many neighbors
    ivec4 row[ROW_PARTS];  // these, counter-clockwise from the smallest number
};

int lineOfRank(in Cell cell, in Order order, int rank) {
#ifdef WEIGHTED
    int line = cell.last;
#else
    int line = 0;
#endif
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        line = order.rank[k] == rank ? cell.line[k] : line;
    }
    return line;
}

// Clips the entry. With weights, one that is empty has the lines that leave nothing of it, in any order, the last
// one behind those of the slots.
Answer answerEntry() {
    Cell cell;
    int status = clipEntry(cell, vec2(0.0));
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        cell.line[k] = neighborOf(cell.line[k]);
    }
    Order order;
    orderEdges(cell, order);
    beginAtFirst(cell, order);
    int count = status == CELL_CERTIFIED ? order.count : 0;
#ifdef WEIGHTED
    cell.last = neighborOf(cell.last);
    bool empty = status == CELL_EMPTY;
    UNROLL for (int k = 0; k < EDGE_END; k++) {
        order.rank[k] = empty ? k : order.rank[k];
    }
    count = empty ? MAX_EDGES + 1 : count;
#endif
    Answer answer;
    answer.word = status + count * 256;
    UNROLL for (int part = 0; part < ROW_PARTS; part++) {
        answer.row[part] = ivec4(lineOfRank(cell, order, part * 4), lineOfRank(cell, order, part * 4 + 1),
                                 lineOfRank(cell, order, part * 4 + 2), lineOfRank(cell, order, part * 4 + 3));
    }
    return answer;
}
