// How all overlays look.
#pragma once

namespace seascape {

// Of the current ImGui context, for a font `scale` times its own size.
void set_overlay_style(float scale);

}  // namespace seascape
