#version 330 core
// A quad over the whole picture; the fragment shader does the rest.
layout(location = 0) in vec2 corner;

void main() {
    gl_Position = vec4(corner, 0.0, 1.0);
}
