// Texts, and the numbers and conditions that come from them; system variables.
#include <fmt/format.h>

#include "tests/random/maker.h"

namespace ncport::tests::random {

using ir::ExprId;
using ir::ExprOp;
using ir::Type;

namespace {
constexpr std::string_view kTexts[] = {"DEPTH ", "Z=",   "PART",    "a b",  "OK", "x",
                                       "12",     "-3.5", "RING; 2", "L(1)", "",   "CHECK %"};
}  // namespace

ExprId Maker::TextLiteral() { return expr_.Text(random_.Pick(kTexts)); }

// At most about 100 characters: texts have limits of their own on controls.
ExprId Maker::TextValue(int depth) {
  const std::uint32_t way = depth > 0 && Draw(Feature::kTextFunctions) ? 2 + random_.Below(9) : random_.Below(2);
  switch (way) {
    case 0:
      return TextLiteral();
    case 1: {
      const Place* const place = FindPlace(Range::kText, Type::kString);
      return place != nullptr ? PlaceExpr(*place, depth) : TextLiteral();
    }
    case 2:
      return expr_.Function(ir::Function::kToUpper, {TextLiteral()}, Type::kString);
    case 3:
      return expr_.Function(ir::Function::kToLower, {TextLiteral()}, Type::kString);
    case 4: {
      const ExprId text = TextValue(0);
      const Made first = NumberIn({0, 3, true}, 0);
      if (random_.Percent(50))
        return expr_.Function(ir::Function::kSubstring, {text, As(first, Type::kInt)}, Type::kString);
      const Made count = NumberIn({0, 12, true}, 0);
      return expr_.Function(ir::Function::kSubstring, {text, As(first, Type::kInt), As(count, Type::kInt)},
                            Type::kString);
    }
    case 5:
      return expr_.Function(ir::Function::kToText, {Number(1).id}, Type::kString);
    case 6: {
      const ExprId format = expr_.Text(random_.Percent(50) ? "N%d/%5d" : "%8.3f %f");
      const bool whole = module_.View(StringId{module_.exprs[format].a}).find('d') != std::string_view::npos;
      const auto value = [&] {
        return whole ? As(NumberIn({-100, 100, true}, 1), Type::kInt) : As(NumberIn({-40, 40, false}, 1), Type::kReal);
      };
      const ExprId first = value();
      return expr_.Function(ir::Function::kFormat, {format, first, value()}, Type::kString);
    }
    default: {
      ExprId text = random_.Percent(30) ? TextValue(0) : TextLiteral();
      const std::uint32_t parts = 1 + random_.Below(2);
      for (std::uint32_t i = 0; i < parts; ++i) {
        const ExprId next = random_.Percent(70) ? Number(random_.Percent(30) ? 1 : 0).id : TextLiteral();
        text = expr_.Binary(ExprOp::kConcat, text, next);
        module_.exprs[text].type = Type::kString;
      }
      return text;
    }
  }
}

Maker::Made Maker::TextNumber(int depth) {
  using F = ir::Function;
  const ExprId text = TextValue(depth > 0 ? 1 : 0);
  switch (random_.Below(6)) {
    case 0:
      return {expr_.Function(F::kStringLength, {text}, Type::kInt), Type::kInt, {0, 200, true}};
    case 1:
      return {expr_.Function(F::kFind, {text, expr_.Text("1")}, Type::kInt), Type::kInt, {-1, 200, true}};
    case 2:
      return {expr_.Function(F::kIndexOfAny, {text, expr_.Text("12=")}, Type::kInt), Type::kInt, {-1, 200, true}};
    case 3:
      return {expr_.Function(F::kIndexOf, {text, expr_.Text("E")}, Type::kInt), Type::kInt, {-1, 200, true}};
    case 4:
      return {expr_.Function(F::kLastIndexOf, {text, expr_.Text("A")}, Type::kInt), Type::kInt, {-1, 200, true}};
    default: {
      const ExprId number = expr_.Text(random_.Percent(50) ? "12.25" : "-7");
      return {expr_.Function(F::kParseNumber, {number}, Type::kReal), Type::kReal, {-7, 12.25, false}};
    }
  }
}

ExprId Maker::TextTruth(int depth) {
  if (random_.Percent(30)) return expr_.Function(ir::Function::kIsNumber, {TextLiteral()}, Type::kBool);
  const ExprId left = TextValue(depth);
  return expr_.Binary(random_.Percent(50) ? ExprOp::kEqual : ExprOp::kNotEqual, left, TextLiteral());
}

// A position in any unit stays below 5000.
Maker::Made Maker::SystemNumber() {
  if (!position_known_ || random_.Percent(40)) return {expr_.System(pi_), Type::kReal, {3.14, 3.15, false}};
  const ExprId axis = expr_.AxisName(random_.Percent(50) ? 0 : 2);
  return {expr_.System(programmed_position_, {axis}), Type::kReal, {-5000, 5000, false}};
}

}  // namespace ncport::tests::random
