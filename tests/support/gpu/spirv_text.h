// What a SPIR-V module says, whatever numbers it gives to what it names: two modules of the same code have the same
// text.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace seascape::test {

// Types, constants and variables are named by what they are and how they are decorated and come in the order of these
// names; what a function computes is numbered as it comes. An empty text where the words are no module.
std::string spirv_text(const std::vector<std::uint32_t>& words);

}  // namespace seascape::test
