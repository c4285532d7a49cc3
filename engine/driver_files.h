// The files by which the Vulkan loader finds drivers, where the environment names them.
#pragma once
#include <string>

namespace seascape {

// What is wrong with the first faulty file that VK_DRIVER_FILES, or else VK_ICD_FILENAMES, or VK_ADD_DRIVER_FILES
// names: "VK_DRIVER_FILES names /a.json, which is not JSON". Empty where none is named or none is faulty. For when no
// driver answers: the loader itself says only that memory ran out or that there is none.
std::string driver_files_fault();

}  // namespace seascape
