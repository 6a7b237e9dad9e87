// Runs a judgement in a process of its own: a fault may crash, or never end.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace ncport::tests::faults {

/// Calls `judge(i)` for each i below `count`, each in a child of this process, a few at once; its answer, or how the
/// child ended. Children are told nothing of each other: each starts with what this process has read so far.
std::vector<std::string> JudgeAll(std::size_t count, const std::function<std::string(std::size_t)>& judge);

}  // namespace ncport::tests::faults
