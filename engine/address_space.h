// Whether a process may still map as much memory as a Vulkan driver takes to start.
#pragma once

namespace seascape {

// Throws Error where a limit (ulimit -v) leaves less than drivers need. With less, Mesa's software driver and the
// loader do not say so: they crash, hang in vkDestroyInstance or throw through C.
void expect_address_space();

}  // namespace seascape
