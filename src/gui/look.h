#pragma once
// How the panels look: their font and colours.

namespace mb {

/// Sets the font and the style of the current Dear ImGui context, for a screen of that scale (1: about 96 dots an inch).
void setLook(float scale);

}  // namespace mb
