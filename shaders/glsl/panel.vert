#version 450
// Hands on a corner of a triangle that lies over the picture of a window: of the panel, or of a picture that is
// moved or scaled.
layout(location = 0) in vec2 in_position;  // normalized device coordinates
layout(location = 1) in vec2 in_texel;     // 0 to 1
layout(location = 2) in vec4 in_color;

out gl_PerVertex { vec4 gl_Position; };
layout(location = 0) out vec2 texel;
layout(location = 1) out vec4 color;

void main() {
    gl_Position = vec4(in_position, 0.0, 1.0);
    texel = in_texel;
    color = in_color;
}
