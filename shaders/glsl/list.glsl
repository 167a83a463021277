// The search in a list, fused with the clipping. Its includer has included cell.glsl and
// defines before it
//   vec4 lineAt(int index)  line `index` of the list: normal.xy, h, bound

// Clips the cell by the lines first .. first + count - 1, which come in ascending order of bound,
// until the rest is proved unable to cut. outset moves every line outward, by up to its two
// components along x and y: nothing, to measure; what view_uniform.h says, to draw. Where it is
// negative, lines move inward, and sites cut that are farther away by twice as much.
// reach bounds from below the distance of every site that is not in the list.
int clipCell(INOUT(Cell) c, vec4 walls, vec2 outset, int first, int count, real reach, real origin_offset) {
    beginCell(c, vec4(walls.x - outset.x, walls.y - outset.y, walls.z + outset.x, walls.w + outset.y));
    real away = origin_offset + max(-(outset.x + outset.y), real(0.0));
    real security = securityRadius(squaredRadius(c), away);
    real unseen = reach;
    for (int i = 0; i < count; i++) {
        vec4 line = lineAt(first + i);
        if (line.w >= security) {
            unseen = line.w;
            break;
        }
        real wider = abs(line.x) * outset.x + abs(line.y) * outset.y;
        cutCell(c, vec2(line.x, line.y), line.z + wider, first + i);
        if (c.overflow || c.empty) {
            break;
        }
        security = securityRadius(squaredRadius(c), away);
    }
    return outcome(c, unseen < security);
}
