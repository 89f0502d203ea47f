// Tests that the embedded shaders keep the rules of the shared text: arithmetic that decides a hit may not be contracted, and
// the shaders use nothing whose last bit a device may choose.

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

// The headers written by glslang rely on <cstdint>.
#include "direct.spirv.h"
#include "direct_storage.spirv.h"
#include "packets.spirv.h"
#include "packets_storage.spirv.h"
#include "rounds_book.spirv.h"
#include "rounds_emit.spirv.h"
#include "view.spirv.h"
#include "view_storage.spirv.h"

namespace sunfleck {
namespace {

// Numbers from the SPIR-V specification 1.5, section 3: instructions and decorations.
enum : std::uint32_t {
  op_name = 5,
  op_ext_inst = 12,
  op_function = 54,
  op_function_end = 56,
  op_decorate = 71,
  op_f_add = 129,
  op_f_sub = 131,
  op_f_mul = 133,
  op_f_div = 136,
  op_f_rem = 140,
  op_f_mod = 141,
  op_vector_times_scalar = 142,
  op_dot = 148,
  no_contraction = 42,
};
// From GLSL.std.450: floor, which is exact everywhere, and of unsigned numbers min, max, findLSB and findMSB.
const std::set<std::uint32_t> allowed_library_calls = {8, 38, 41, 73, 75};

struct Instruction {
  std::uint32_t code;
  std::span<const std::uint32_t> operands;
};

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> spirv) {
  std::vector<Instruction> all;
  for (std::size_t at = 5; at < spirv.size();) {
    const std::uint32_t words = spirv[at] >> 16U;
    all.push_back({spirv[at] & 0xffffU, spirv.subspan(at + 1, words - 1)});
    at += words;
  }
  return all;
}

// Returns the name up to the bracket after which glslang writes the types of parameters.
std::string text_of(std::span<const std::uint32_t> words) {
  const auto* text = reinterpret_cast<const char*>(words.data());
  const std::string name(text);
  return name.substr(0, name.find('('));
}

bool rounds(std::uint32_t code) {
  return code == op_f_add || code == op_f_sub || code == op_f_mul;
}

// Counts the products and sums of floats per function: those that may be contracted, and all.
struct Sums {
  std::map<std::string, int> contractible;
  int all = 0;
};

Sums sums_of(const std::vector<Instruction>& instructions) {
  std::map<std::uint32_t, std::string> names;
  std::set<std::uint32_t> exact;
  for (const Instruction& it : instructions) {
    if (it.code == op_name) names[it.operands[0]] = text_of(it.operands.subspan(1));
    if (it.code == op_decorate && it.operands[1] == no_contraction) exact.insert(it.operands[0]);
  }
  Sums sums;
  std::string function;
  for (const Instruction& it : instructions) {
    if (it.code == op_function) function = names[it.operands[1]];
    if (!rounds(it.code)) continue;
    ++sums.all;
    if (!exact.contains(it.operands[1])) ++sums.contractible[function];
  }
  return sums;
}

const std::map<std::string, std::span<const std::uint32_t>> shaders = {
    {"direct", direct_spirv},    {"direct_storage", direct_storage_spirv},
    {"packets", packets_spirv},  {"packets_storage", packets_storage_spirv},
    {"emit", rounds_emit_spirv}, {"book", rounds_book_spirv},
    {"view", view_spirv},        {"view_storage", view_storage_spirv}};

class EmbeddedShader : public testing::TestWithParam<std::string> {};

TEST_P(EmbeddedShader, ContractsNothingThatDecides) {
  const Sums sums = sums_of(instructions_of(shaders.at(GetParam())));
  const bool walks = GetParam() != "emit" && GetParam() != "book";
  EXPECT_GT(sums.all, walks ? 75 : 10);
  // Boxes are padded for the rounding of their test, in either direction: 3 operations on vectors for the node, 12 for a child.
  std::map<std::string, int> expected;
  if (walks) expected["meet_children"] = 15;
  EXPECT_EQ(sums.contractible, expected);
}

TEST_P(EmbeddedShader, UsesNothingThatDevicesRoundDifferently) {
  for (const Instruction& it : instructions_of(shaders.at(GetParam()))) {
    for (const std::uint32_t forbidden : {op_f_div, op_f_rem, op_f_mod, op_vector_times_scalar, op_dot}) {
      EXPECT_NE(it.code, forbidden);
    }
    if (it.code == op_ext_inst) {
      EXPECT_TRUE(allowed_library_calls.contains(it.operands[3])) << it.operands[3];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EmbeddedShader,
                         testing::Values("direct", "direct_storage", "packets", "packets_storage", "view", "view_storage",
                                         "emit", "book"),
                         [](const auto& shader) { return shader.param; });

}  // namespace
}  // namespace sunfleck
