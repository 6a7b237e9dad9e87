#include "ir/motions.h"

#include <doctest/doctest.h>

namespace ncport::ir {
namespace {

TEST_CASE("motions: arcs of the plane, arcs, moves at the feed") {
  for (const Motion motion : {Motion::kArcCw, Motion::kArcCcw}) {
    CHECK(IsPlaneArc(motion));
    CHECK(IsArc(motion));
    CHECK(IsFeedMotion(motion));
  }
  for (const Motion motion : {Motion::kArcVia, Motion::kArcTangent}) {
    CHECK_FALSE(IsPlaneArc(motion));
    CHECK(IsArc(motion));
    CHECK(IsFeedMotion(motion));
  }
  CHECK(IsFeedMotion(Motion::kLinear));
  CHECK_FALSE(IsArc(Motion::kLinear));
  for (const Motion motion :
       {Motion::kUnknown, Motion::kNone, Motion::kRapid, Motion::kThread, Motion::kThreadIncreasing,
        Motion::kThreadDecreasing, Motion::kTapIn, Motion::kTapOut, Motion::kTapFloating, Motion::kProbe}) {
    CHECK_FALSE(IsPlaneArc(motion));
    CHECK_FALSE(IsArc(motion));
    CHECK_FALSE(IsFeedMotion(motion));
  }
}

}  // namespace
}  // namespace ncport::ir
