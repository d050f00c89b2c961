// Static casters on a grid of cells: a pixel's ray is the line through the centres of cells along `axis`.
layout(location = 0) in vec3 position;
layout(location = 5) in mat3x4 model_rows;  // of the instance: rows of the affine model matrix

uniform vec3 low;        // centre of the first cell, m
uniform float per_cell;  // cells a metre
uniform ivec3 cells;
uniform int axis;

out vec3 cell;

void main() {
    cell = (vec4(position, 1.0) * model_rows - low) * per_cell;
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    gl_Position = vec4(vec2(cell[u] + 0.5, cell[v] + 0.5) * 2.0 / vec2(cells[u], cells[v]) - 1.0, 0.5, 1.0);
}
