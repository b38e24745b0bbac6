#include "bench/drive/file_identity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <memory>
#include <span>
#include <vector>

namespace canhil::drive {

std::optional<FileIdentity> identify_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  if (!file || !digest || EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1) return std::nullopt;
  constexpr std::size_t block_bytes = 1 << 16;
  std::vector<char> block(block_bytes);
  FileIdentity identity{.sha256 = {}, .bytes = 0, .modified_s = status.st_mtim.tv_sec};
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    if (EVP_DigestUpdate(digest.get(), block.data(), count) != 1) return std::nullopt;
    identity.bytes += count;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned size = 0;
  if (file.bad() || EVP_DigestFinal_ex(digest.get(), hash.data(), &size) != 1) return std::nullopt;
  identity.sha256 = fmt::format("{:02x}", fmt::join(std::span(hash).first(size), ""));
  return identity;
}

}  // namespace canhil::drive
