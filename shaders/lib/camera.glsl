// The ray of a pixel, as docs and the command line state it: through the pixel's centre, y counted from the top.

struct Ray {
    vec3 origin;      // relative to the eye
    vec3 direction;
    float travelled;  // metres from the eye to the origin, along the path
};

Ray cameraRay(vec2 pixel) {
    vec2 at = (pixel + frame.picture.zw) / frame.picture.xy * 2.0 - 1.0;  // gl_FragCoord counts y from the bottom
    vec3 across = frame.right.xyz * at.x + frame.up.xyz * at.y;
    if (frame.right.w != 0.0) return Ray(across, frame.forward.xyz, 0.0);
    return Ray(vec3(0.0), normalize(frame.forward.xyz + across), 0.0);
}

// The depth buffer's value for a distance along the ray: 0 at the eye, 1 at the furthest that is seen.
float depthOf(float t) {
    return clamp(t / frame.reach.y, 0.0, 1.0);
}
