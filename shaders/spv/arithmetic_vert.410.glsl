#version 410

layout(location = 0) in vec4 operands;
layout(location = 0) flat out vec4 computed_first;
layout(location = 1) flat out vec4 computed_second;

void main()
{
    precise float _122 = operands.x * operands.y;
    precise float _125 = _122 + operands.z;
    precise float _130 = operands.x - operands.y;
    precise float _135 = operands.z - operands.w;
    precise float _136 = _130 + _135;
    float _144 = abs(operands.x);
    computed_first = vec4(operands.x / operands.y, sqrt(_144), inversesqrt(_144), operands.x * operands.y);
    computed_second = vec4(operands.x + operands.y, fma(operands.x, operands.y, operands.z), _125, _136);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}

