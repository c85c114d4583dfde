// What a film makes of light: dark tones in proportion, bright ones ever closer to white (Reinhard, Stark, Shirley and Ferwerda,
// "Photographic Tone Reproduction for Digital Images", 2002, equation 3, for each color).

vec3 developed(vec3 light) {
    vec3 exposed = renderExposure() * light;
    return renderExposure() > 0.0 ? exposed / (1.0 + exposed) : light;
}
