#include "frontend/common/shape_cache.h"

#include <utility>

namespace ncport::frontend {

std::uint64_t ShapeCache::HashOf(std::span<const Token> tokens) {
  std::uint64_t hash = tokens.size();
  for (const Token& token : tokens) hash = (hash ^ token.kind) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32U);
}

bool ShapeCache::Equal(const Shape& shape, std::span<const Token> tokens) const {
  if (shape.count != tokens.size()) return false;
  const std::uint16_t* kinds = kinds_.data() + shape.begin;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (kinds[i] != tokens[i].kind) return false;
  }
  return true;
}

const Recipe* ShapeCache::Find(std::span<const Token> tokens) {
  last_hash_ = HashOf(tokens);
  if (slots_.empty()) return nullptr;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = last_hash_ & mask;; slot = (slot + 1) & mask) {
    const std::uint32_t index = slots_[slot];
    if (index == kFree) return nullptr;
    if (shapes_[index].hash == last_hash_ && Equal(shapes_[index], tokens)) return &shapes_[index].recipe;
  }
}

const Recipe& ShapeCache::Add(std::span<const Token> tokens, Recipe recipe) {
  if (slots_.empty() || shapes_.size() == kMaxShapes || kinds_.size() + tokens.size() > kMaxKinds) Clear();
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = last_hash_ & mask;
  while (slots_[slot] != kFree) slot = (slot + 1) & mask;
  slots_[slot] = static_cast<std::uint32_t>(shapes_.size());
  Shape& shape = shapes_.emplace_back();
  shape.hash = last_hash_;
  shape.begin = static_cast<std::uint32_t>(kinds_.size());
  shape.count = static_cast<std::uint32_t>(tokens.size());
  shape.recipe = std::move(recipe);
  for (const Token& token : tokens) kinds_.push_back(token.kind);
  return shape.recipe;
}

void ShapeCache::Clear() {
  shapes_.clear();
  kinds_.clear();
  slots_.assign(kMaxShapes * 2, kFree);
}

}  // namespace ncport::frontend
