// The walk of ir/verify.h through a module; only the verify*.cc include it. Each method is a list of independent
// checks; the first that fails is kept with its place.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/enum_names.h"
#include "ir/verify.h"

namespace ncport::ir {

struct Violation {
  std::string text;
  BlockId block;
};

class Verifier {
 public:
  Verifier(const Module& module, const VerifyOptions& options) : m_(module), options_(options) {}

  std::optional<Violation> Run() {
    const bool ok = Tables() && Exprs() && Lists() && Records() && Variables() && Origins() && Programs();
    if (ok) return std::nullopt;
    return violation_;
  }

 private:
  // --- small checks

  /// What is being checked; made into text only when something is wrong.
  void At(std::string_view what, std::uint32_t number = Id<void>::kNone, std::string_view name = {}) {
    what_ = what;
    number_ = number;
    name_ = name;
  }
  std::string Where() const {
    std::string text(what_);
    if (number_ != Id<void>::kNone) text += fmt::format(" {}", number_);
    if (!name_.empty()) text += fmt::format(" ({})", name_);
    return text.empty() ? text : text + ": ";
  }

  template <class... Args>
  bool Fail(fmt::format_string<Args...> format, Args&&... args) {
    if (violation_.text.empty()) {
      violation_ = {Where() + fmt::format(format, std::forward<Args>(args)...), block_};
    }
    return false;
  }
  bool Check(bool condition, std::string_view what) { return condition || Fail("{}", what); }
  bool String(StringId id, std::string_view what, bool may_be_missing = true) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return id.value < m_.strings.Size() || Fail("{} is string {} of {}", what, id.value, m_.strings.Size());
  }
  bool File(FileId id) {
    if (!id.Valid()) return true;
    return (id.value < m_.file_names.size() && m_.file_names[id.value].Valid()) ||
           Fail("file {} has no name", id.value);
  }
  bool Operand(ExprId id, std::string_view what, bool may_be_missing = true) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return m_.exprs.Contains(id) || Fail("{} is expression {} of {}", what, id.value, m_.exprs.Size());
  }
  /// Something that can be assigned to.
  bool Place(ExprId id, std::string_view what, bool may_be_missing = true) {
    if (!Operand(id, what, may_be_missing)) return false;
    if (!id.Valid()) return true;
    switch (m_.exprs[id].op) {
      case ExprOp::kVariable:
      case ExprOp::kElement:
      case ExprOp::kCell:
      case ExprOp::kCellAt:
      case ExprOp::kSystem:
      case ExprOp::kName:
        return true;
      default:
        return Fail("{} is {}, which cannot be written", what, NameOf(m_.exprs[id].op));
    }
  }
  bool Range(std::uint64_t begin, std::uint64_t count, std::size_t size, std::string_view what) {
    return count == 0 || begin + count <= size || Fail("{} {} to {} of {}", what, begin, begin + count, size);
  }
  template <class Enum>
  bool Enumerator(Enum value, std::string_view what) {
    return IsKnown(value) || Fail("{} {} is not in its list", what, static_cast<unsigned>(value));
  }
  template <class Store, class IdType>
  bool Record(const Store& store, IdType id, std::string_view what, bool may_be_missing = false) {
    if (!id.Valid()) return may_be_missing || Fail("{} is missing", what);
    return store.Contains(id) || Fail("{} {} of {}", what, id.value, store.Size());
  }
  bool Axis(std::uint64_t axis) {
    return axis < kLetterAxes || (axis < kMaxAxes && axis - kFirstNamedAxis < m_.axis_names.size()) ||
           Fail("axis {} has no name", axis);
  }

  // --- tables
  bool Tables();

  // --- expressions
  bool Exprs();
  bool Child(ExprId parent, ExprId child);
  static ExprId Raw(std::uint32_t value);
  bool Children(ExprId id, const ir::Expr& expr, std::uint32_t least, std::uint32_t most);
  bool Expr(ExprId id);
  bool Literal(const ir::Expr& expr);

  // --- records that words lead to
  bool Lists();
  bool TargetOk(const Target& target);
  bool Records();
  bool Dimensions(std::uint8_t count, const std::uint32_t (&dimensions)[3]);
  bool Variables();
  bool Origins();

  // --- programs, blocks, words
  bool Programs();
  bool BlockOk(BlockId id, const Program& program);
  bool WordOk(const Word& word, bool refused);
  bool Index(const Word& word);
  bool Extra(const Word& word, bool refused);

  // --- structure links
  /// The mark of a block; kVerbatim if it has none.
  WordOp MarkOf(const Block& block) const;
  static bool IsOpener(WordOp op);
  static bool Closes(WordOp opener, WordOp closer);
  /// Links as BuildStructure sets them: pairs that nest, ELSE between.
  bool Structure(const Program& program);

  const Module& m_;
  const VerifyOptions& options_;
  Violation violation_;
  std::string_view what_;
  std::uint32_t number_ = Id<void>::kNone;
  std::string_view name_;
  BlockId block_;
  std::vector<std::uint32_t> depths_;
  std::vector<std::uint64_t> nodes_;
};

}  // namespace ncport::ir
