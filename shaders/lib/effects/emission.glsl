// A surface's light of its own.

vec3 emitted(Surface s) { return materialEmission(s.look) * s.color; }
