// Failure without exceptions. What the user did wrong is in the diag::Sink; a Status only says whether to go on.
// What we did wrong stops the program: NCPORT_BUG, NCPORT_CHECK.
#pragma once

#include <fmt/core.h>

#include <optional>
#include <utility>

namespace ncport {

/// Converts to a failed Status or Result: `return Failure{};`
struct Failure {};

/// Ok or failed. `return {};` is ok.
class [[nodiscard]] Status {
 public:
  constexpr Status() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): so that `return Failure{};` reads well
  constexpr Status(Failure) : ok_(false) {}

  [[nodiscard]] constexpr bool Ok() const { return ok_; }

  /// Ok if both are. Both sides are always evaluated: `ok = ok & Lower(line)` goes on after an error and remembers it.
  friend constexpr Status operator&(Status a, Status b) { return a.ok_ ? b : a; }
  constexpr Status& operator&=(Status other) { return *this = *this & other; }

 private:
  bool ok_ = true;
};

namespace detail {
[[noreturn]] void BugText(const char* file, int line, fmt::string_view format, fmt::format_args args);

template <class... Args>
[[noreturn]] void Bug(const char* file, int line, fmt::format_string<const Args&...> format, const Args&... args) {
  BugText(file, line, format, fmt::make_format_args(args...));
}
}  // namespace detail

/// Prints what to report to standard error and exits with 70. Handlers of std::at_quick_exit run (temporary files).
#define NCPORT_BUG(...) ::ncport::detail::Bug(__FILE__, __LINE__, __VA_ARGS__)

/// NCPORT_BUG with this message unless the condition holds. Stays in release builds. The message costs nothing unless
/// it fails.
#define NCPORT_CHECK(condition, ...) \
  do {                               \
    if (!(condition)) [[unlikely]] { \
      NCPORT_BUG(__VA_ARGS__);       \
    }                                \
  } while (false)

/// A value or failure.
template <class T>
class [[nodiscard]] Result {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): `return value;`
  Result(T value) : value_(std::move(value)) {}
  // NOLINTNEXTLINE(google-explicit-constructor): `return Failure{};`
  Result(Failure) {}

  [[nodiscard]] bool Ok() const { return value_.has_value(); }

  /// Asking a failed result is a bug.
  [[nodiscard]] T& Value() & {
    Need();
    return *value_;
  }
  [[nodiscard]] const T& Value() const& {
    Need();
    return *value_;
  }
  [[nodiscard]] T&& Value() && {
    Need();
    return *std::move(value_);
  }
  [[nodiscard]] T& operator*() & { return Value(); }
  [[nodiscard]] const T& operator*() const& { return Value(); }
  [[nodiscard]] T&& operator*() && { return std::move(*this).Value(); }
  [[nodiscard]] T* operator->() { return &Value(); }
  [[nodiscard]] const T* operator->() const { return &Value(); }

  /// Without the value.
  [[nodiscard]] Status ToStatus() const { return Ok() ? Status{} : Status{Failure{}}; }

 private:
  void Need() const { NCPORT_CHECK(value_.has_value(), "value of a failed result was used"); }

  std::optional<T> value_;
};

#define NCPORT_CONCAT_INNER(a, b) a##b
#define NCPORT_CONCAT(a, b) NCPORT_CONCAT_INNER(a, b)

/// Leaves the function (which returns a Status or Result) with failure if the Status or Result `expr` failed.
#define NCPORT_TRY(...)                                  \
  do {                                                   \
    if (!(__VA_ARGS__).Ok()) return ::ncport::Failure{}; \
  } while (false)

/// `NCPORT_TRY_ASSIGN(const auto value, Compute());`: declares `decl` from the value of the Result, or leaves with
/// failure.
#define NCPORT_TRY_ASSIGN(decl, ...) NCPORT_TRY_ASSIGN_INNER(NCPORT_CONCAT(ncport_result_, __LINE__), decl, __VA_ARGS__)
#define NCPORT_TRY_ASSIGN_INNER(result, decl, ...) \
  auto result = (__VA_ARGS__);                     \
  if (!result.Ok()) return ::ncport::Failure{};    \
  decl = std::move(result).Value()

}  // namespace ncport
