// Mooring lines and anchor chains as they are seen: catenaries of straight pieces, each a thing of the scene, so that
// all of them together are one draw more. Pure.
#pragma once
#include "app/scene_objects.h"
#include "ocean/bodies/sea_bodies.h"

namespace seascape {

inline constexpr std::size_t pieces_a_line = 20;

// Adds room for the lines of the scene and for those that are made by hand: things behind all others, none of them
// shown yet (SceneObjects::lines). False, and adds nothing, where nothing that floats takes a line, or there is room
// already.
bool add_line_things(SceneObjects& objects, const SeaBodies& bodies);
// Has them as the bodies' lines hang at a time (s). Lines beyond the room are not shown. Takes no memory.
void place_lines(SceneObjects& objects, const SeaBodies& bodies, double time_s);

}  // namespace seascape
