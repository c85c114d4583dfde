// Air that takes the same share of the light at every metre, and shines in the background's color instead (Beer's law).

void throughFog(float metres, inout vec3 color, inout float weight) {
    float clear = exp(-worldFog() * metres);
    color += weight * (1.0 - clear) * background();
    weight *= clear;
}
