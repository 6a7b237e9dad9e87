#include "frontend/sinumerik/word_index.h"

#include <array>
#include <charconv>
#include <vector>

#include "base/result.h"
#include "dialects/sinumerik/words.h"

namespace ncport::frontend::sinumerik {

namespace {

namespace words = dialects::sinumerik;
using K = TokenKind;

constexpr std::uint8_t Sub(ir::Search search) { return static_cast<std::uint8_t>(search); }
constexpr std::uint8_t Sub(ir::Scope scope) { return static_cast<std::uint8_t>(scope); }

constexpr WordEntry kKeywords[] = {
    {"DEF", K::kDef},
    {"NCK", K::kDefScope, Sub(ir::Scope::kGlobal)},
    {"CHAN", K::kDefScope, Sub(ir::Scope::kChannel)},
    {"LLI", K::kLowerLimit},
    {"ULI", K::kUpperLimit},
    {"DEFINE", K::kDefine},
    {"AS", K::kAs},
    {"PROC", K::kProc},
    {"EXTERN", K::kExtern},
    {"VAR", K::kVar},
    {"SET", K::kSet},
    {"REP", K::kRep},
    {"IF", K::kIf},
    {"ELSE", K::kElse},
    {"ENDIF", K::kEndIf},
    {"WHILE", K::kWhile},
    {"ENDWHILE", K::kEndWhile},
    {"FOR", K::kFor},
    {"TO", K::kTo},
    {"ENDFOR", K::kEndFor},
    {"LOOP", K::kLoop},
    {"ENDLOOP", K::kEndLoop},
    {"REPEAT", K::kRepeat},
    {"REPEATB", K::kRepeatBlock},
    {"UNTIL", K::kUntil},
    {"GOTO", K::kGoto, Sub(ir::Search::kForwardThenBackward)},
    {"GOTOF", K::kGoto, Sub(ir::Search::kForward)},
    {"GOTOB", K::kGoto, Sub(ir::Search::kBackward)},
    {"GOTOC", K::kGoto, Sub(ir::Search::kForwardThenBackward), 1},
    {"GOTOS", K::kGotoStart},
    {"CASE", K::kCase},
    {"OF", K::kOf},
    {"DEFAULT", K::kDefault},
    {"CALL", K::kCall},
    {"BLOCK", K::kBlockRange},
    {"PCALL", K::kPathCall},
    {"EXTCALL", K::kExternalCall},
    {"MCALL", K::kModalCall},
    {"RET", K::kReturn},
    {"MSG", K::kMessage},
    {"SETAL", K::kSetAlarm},
    {"STOPRE", K::kPreprocessStop},
    {"WORKPIECE", K::kWorkpiece},
    {"TRUE", K::kBoolean, 1},
    {"FALSE", K::kBoolean, 0},
    {"DIV", K::kDivideInteger},
    {"MOD", K::kModulo},
    {"NOT", K::kNot},
    {"B_NOT", K::kBitNot},
    {"B_AND", K::kBitAnd},
    {"B_XOR", K::kBitXor},
    {"B_OR", K::kBitOr},
    {"AND", K::kAnd},
    {"XOR", K::kXor},
    {"OR", K::kOr},
    {"AX", K::kAxisAt},
    {"RG", K::kCellAt, 1},
};

// Groups 1, 2, 3, 9, 10, 15, 31, 32, 47 of card 8.1: known to the control, their effect on a trace is not modelled.
constexpr std::uint32_t kRefusedG[] = {5,   7,   25,  26,  58,  59,  147, 148, 247, 248, 291, 335,
                                       336, 347, 348, 931, 942, 952, 961, 962, 971, 972, 973};
constexpr std::uint32_t kMaxG = 1000;
constexpr std::uint32_t kMaxM = 100;

bool IsCycleName(std::string_view word) {
  for (const std::string_view start : {"CYCLE", "HOLES", "POCKET", "SLOT", "LONGHOLE"}) {
    if (word.substr(0, start.size()) == start) return true;
  }
  return false;
}

class Index {
 public:
  Index() : slots_(kSlots, nullptr) {
    entries_.reserve(kSlots / 2);
    for (const WordEntry& entry : kKeywords) Add(entry);
    AddCodes();
    AddTables();
    // What remains is known to the control: cycles are called like programs, everything else is refused by name.
    for (const std::string_view word : words::ReservedWords()) {
      if (Find(word) == nullptr && !IsCycleName(word)) Add({word, K::kRefused});
    }
  }

  [[nodiscard]] const WordEntry* Find(std::string_view text) const {
    for (std::size_t slot = Hash(text) % kSlots;; slot = (slot + 1) % kSlots) {
      if (slots_[slot] == nullptr || slots_[slot]->text == text) return slots_[slot];
    }
  }
  [[nodiscard]] std::uint32_t G(std::uint32_t number) const { return number < kMaxG ? g_[number] : kAuxiliaryRow; }
  [[nodiscard]] std::uint32_t M(std::uint32_t number) const { return number < kMaxM ? m_[number] : kAuxiliaryRow; }

 private:
  static constexpr std::size_t kSlots = 4096;

  static std::size_t Hash(std::string_view text) {
    std::size_t hash = text.size();
    for (const char c : text) hash = hash * 131 + static_cast<unsigned char>(c);
    return hash ^ (hash >> 15U);
  }

  void Add(const WordEntry& entry) {
    NCPORT_CHECK(entries_.size() < kSlots / 2, "word index is full");
    std::size_t slot = Hash(entry.text) % kSlots;
    while (slots_[slot] != nullptr) {
      NCPORT_CHECK(slots_[slot]->text != entry.text, "word {} stands in two tables", entry.text);
      slot = (slot + 1) % kSlots;
    }
    entries_.push_back(entry);
    slots_[slot] = &entries_.back();
  }

  void AddCodes() {
    g_.fill(kAuxiliaryRow);
    m_.fill(kAuxiliaryRow);
    const auto rows = words::Codes().Rows();
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      const std::string_view text = rows[row].text;
      std::uint32_t number = 0;
      const char* end = text.data() + text.size();
      const bool numbered = std::from_chars(text.data() + 1, end, number).ptr == end;
      if (text[0] == 'G' && numbered) {
        g_[number] = row;
      } else if (text[0] == 'M' && numbered) {
        m_[number] = row;
      } else {
        Add({text, K::kCode, 0, 0, row});
      }
    }
  }

  void AddTables() {
    const auto addresses = words::Addresses();
    for (std::uint32_t row = 0; row < addresses.size(); ++row) {
      const std::string_view text = addresses[row].text;
      if (text.size() > 1 && text[1] >= 'A') Add({text, K::kAddress, 0, 0, row});
    }
    const auto functions = words::Functions();
    for (std::uint32_t row = 0; row < functions.size(); ++row) Add({functions[row].text, K::kFunction, 0, 0, row});
    const auto modes = words::ValueModes();
    for (std::uint32_t row = 0; row < modes.size(); ++row) Add({modes[row].text, K::kMode, 0, 0, row});
    for (const words::TypeRow& type : words::Types()) {
      Add({type.text, type.type == ir::Type::kString ? K::kStringType : K::kType,
           static_cast<std::uint8_t>(type.type)});
    }
    const auto attributes = words::ProgramAttributes();
    for (std::uint32_t row = 0; row < attributes.size(); ++row) Add({attributes[row], K::kAttribute, 0, 0, row});
    for (const std::string_view flag : words::DefinitionFlags()) Add({flag, K::kDefFlag});
    for (const std::string_view value : words::DefinitionValues()) Add({value, K::kDefValue});
    const auto procedures = words::InertProcedures();
    for (std::uint32_t row = 0; row < procedures.size(); ++row) Add({procedures[row], K::kInertCall, 0, 0, row});
  }

  std::vector<WordEntry> entries_;
  std::vector<const WordEntry*> slots_;
  std::array<std::uint32_t, kMaxG> g_{};
  std::array<std::uint32_t, kMaxM> m_{};
};

const Index& TheIndex() {
  static const Index index;
  return index;
}

}  // namespace

const WordEntry* FindWord(std::string_view upper) { return TheIndex().Find(upper); }
std::uint32_t FindGCode(std::uint32_t number) { return TheIndex().G(number); }
std::uint32_t FindMCode(std::uint32_t number) { return TheIndex().M(number); }

bool IsRefusedGCode(std::uint32_t number) {
  if (number >= 810 && number <= 829) return true;  // groups 31 and 32 belong to the builder
  for (const std::uint32_t refused : kRefusedG) {
    if (refused == number) return true;
  }
  return false;
}

}  // namespace ncport::frontend::sinumerik
