// Shop data that the translations of random programs need: what no program says.
#pragma once

#include "dialects/config.h"
#include "dialects/profile.h"
#include "prove/compare.h"

namespace ncport::tests::random {

/// Tools 1 to 14 with three edges and the named ones, each on registers of its own; the work offset that switches all
/// off.
dialects::Config ShopDataFor(const dialects::Profile& target);

/// The way back: the words of such a target to the SINUMERIK words that they stand for.
dialects::Config ShopDataBack(const dialects::Profile& from);

/// The same as maps for a comparison with a program that no translation made: SINUMERIK words to flat ones.
prove::Maps ShopMapsFor(const dialects::Profile& target);

/// A built-in profile whose questions are answered as an example machine would.
dialects::Profile AnsweredProfile(std::string_view name);

}  // namespace ncport::tests::random
