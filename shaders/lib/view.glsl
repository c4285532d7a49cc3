// Which eye a shader works for: gl_ViewIndex in a multiview pass, the push constant where a pass draws one eye.
#ifndef SEASCAPE_VIEW_GLSL
#define SEASCAPE_VIEW_GLSL
#extension GL_EXT_multiview : require
layout(constant_id = value_multiview) const bool multiview = true;
layout(push_constant) uniform Push { DrawPush push; };
int eye_index() { return multiview ? int(gl_ViewIndex) : int(push.eye); }
#endif
