#include "tests/support/gpu/spirv_text.h"

#include <spirv-tools/libspirv.h>
#include <map>
#include <set>
#include <spirv/unified1/spirv.hpp>

namespace seascape::test {

namespace {

struct Instruction {
  std::uint16_t opcode = 0;
  std::uint32_t result = 0;
  std::vector<std::pair<bool, std::uint32_t>> words;  // of the operands but the result; whether it is an id
};

spv_result_t take(void* list, const spv_parsed_instruction_t* parsed) {
  Instruction i{parsed->opcode, parsed->result_id, {}};
  for (std::uint16_t n = 0; n < parsed->num_operands; ++n) {
    const spv_parsed_operand_t& operand = parsed->operands[n];
    const bool id = operand.type == SPV_OPERAND_TYPE_ID || operand.type == SPV_OPERAND_TYPE_TYPE_ID ||
                    operand.type == SPV_OPERAND_TYPE_MEMORY_SEMANTICS_ID || operand.type == SPV_OPERAND_TYPE_SCOPE_ID;
    if (operand.type == SPV_OPERAND_TYPE_RESULT_ID) continue;
    for (std::uint16_t w = 0; w < operand.num_words; ++w) i.words.emplace_back(id, parsed->words[operand.offset + w]);
  }
  static_cast<std::vector<Instruction>*>(list)->push_back(std::move(i));
  return SPV_SUCCESS;
}

bool decorates(std::uint16_t opcode) { return opcode == spv::OpDecorate || opcode == spv::OpMemberDecorate; }

// Names of a module's ids.
class Names {
 public:
  explicit Names(const std::vector<Instruction>& globals) {
    for (const Instruction& i : globals) {
      if (i.result != 0) global_[i.result] = &i;
      if (decorates(i.opcode)) decorations_[i.words.front().second].insert(text(i, 1));
    }
  }
  // Of an operand or a result: that of what it is, or the number at which it first came.
  std::string of(std::uint32_t id) {
    const auto found = global_.find(id);
    if (found == global_.end()) return "%" + std::to_string(local_.emplace(id, local_.size()).first->second);
    const auto known = known_.find(id);
    if (known != known_.end()) return known->second;
    known_[id] = "(itself)";
    std::string name = "(" + text(*found->second, 0);
    for (const std::string& decoration : decorations_[id]) name += " " + decoration;
    return known_[id] = name + ")";
  }
  std::string text(const Instruction& i, std::size_t from) {
    std::string result = "Op" + std::to_string(i.opcode);
    for (std::size_t n = from; n < i.words.size(); ++n)
      result += " " + (i.words[n].first ? of(i.words[n].second) : std::to_string(i.words[n].second));
    return result;
  }

 private:
  std::map<std::uint32_t, const Instruction*> global_;
  std::map<std::uint32_t, std::set<std::string>> decorations_;
  std::map<std::uint32_t, std::string> known_;
  std::map<std::uint32_t, std::size_t> local_;
};

}  // namespace

std::string spirv_text(const std::vector<std::uint32_t>& words) {
  std::vector<Instruction> all;
  spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_1);
  const spv_result_t parsed = spvBinaryParse(context, &all, words.data(), words.size(), nullptr, take, nullptr);
  spvContextDestroy(context);
  if (parsed != SPV_SUCCESS) return {};
  std::vector<Instruction> globals, bodies;
  for (Instruction& i : all) (bodies.empty() && i.opcode != spv::OpFunction ? globals : bodies).push_back(std::move(i));
  Names names(globals);
  std::multiset<std::string> declared;
  std::string text;
  for (const Instruction& i : globals) {
    if (decorates(i.opcode)) continue;  // with what it decorates
    if (i.result != 0) {
      declared.insert(names.of(i.result));
    } else if (i.opcode == spv::OpEntryPoint) {  // its interface in any order
      std::multiset<std::string> operands;
      for (const auto& [id, word] : i.words) operands.insert(id ? names.of(word) : std::to_string(word));
      for (const std::string& operand : operands) text += operand + " ";
      text += "\n";
    } else {
      text += names.text(i, 0) + "\n";
    }
  }
  for (const std::string& name : declared) text += name + "\n";
  for (const Instruction& i : bodies)
    text += (i.result != 0 ? names.of(i.result) + " = " : "") + names.text(i, 0) + "\n";
  return text;
}

}  // namespace seascape::test
