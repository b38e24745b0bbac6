#include "bench/world/stream.hpp"

#include <boost/random/uniform_01.hpp>

#include "bench/world/hash.hpp"

namespace canhil::world {
namespace {

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection in which every input bit affects every
/// output bit.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

}  // namespace

Stream::Stream(std::uint64_t seed, std::uint64_t run, std::string_view name)
    : engine_(mixed(mixed(mixed(seed) ^ run) ^ fnv1a_64(name))) {}

Vector3 Stream::normal3() {
  const double x = normal();
  const double y = normal();
  const double z = normal();
  return {x, y, z};
}

double Stream::uniform() { return boost::random::uniform_01<double>()(engine_); }

Vector3 draw(const RandomConstant& constant, Stream& stream) {
  return constant.value + constant.sigma.cwiseProduct(stream.normal3());
}

}  // namespace canhil::world
