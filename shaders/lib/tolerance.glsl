// How close is close, in one place. Every bias and every step's floor comes from these two.

// What a distance cannot tell from 0: four units in the last place of the coordinates it is computed from.
float noiseAt(float travelled) { return 4.0 * 1.1920929e-7 * (travelled + frame.reach.w); }

// Nearer than this to a surface, a ray stops trusting single distances and looks for a change of sign.
float closeAt(float travelled) { return max(frame.reach.x * travelled, 4.0 * noiseAt(travelled)); }

// How far a ray that leaves a surface starts from it: by itself outside the region where it would look for a change of sign.
float biasAt(float travelled) { return frame.march.y * closeAt(travelled); }
