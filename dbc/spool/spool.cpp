#include "dbc/spool/spool.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace canhil {
namespace {

int open_in(const std::string& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = folder + "/canhil-XXXXXX";  // some file systems have no unnamed files (O_TMPFILE)
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

// Makes a file of `bytes` bytes; -1: this is not possible. The disk space is allocated now: otherwise a later
// page fault would kill the program if the disk were full.
int open_file(std::size_t bytes) {
  const char* folder = std::getenv("TMPDIR");
  const int file = open_in(folder != nullptr && *folder != '\0' ? folder : "/var/tmp");
  if (file < 0 || posix_fallocate(file, 0, static_cast<off_t>(bytes)) == 0) return file;
  close(file);
  return -1;
}

void* checked(void* mapped) {
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  return mapped;
}

void* anonymous(std::size_t bytes) {
  return checked(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
}

}  // namespace

SpoolFile::SpoolFile() : file_(open_file(step_bytes)) {
  if (file_ < 0) {
    data_ = anonymous(bytes_);
    return;
  }
  data_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (data_ == MAP_FAILED) {
    close(file_);
    throw std::bad_alloc();
  }
  munlock(data_, bytes_);  // in case the process locks its memory: locked pages cannot be released
}

SpoolFile::~SpoolFile() {
  munmap(data_, bytes_);
  if (file_ >= 0) close(file_);
}

void SpoolFile::grow() {
  const std::size_t larger = bytes_ + step_bytes;
  if (file_ >= 0 && posix_fallocate(file_, static_cast<off_t>(bytes_), step_bytes) != 0)
    return into_memory(larger);
  data_ = checked(mremap(data_, bytes_, larger, MREMAP_MAYMOVE));
  bytes_ = larger;
}

// Moves the data from the file into ordinary memory. Called when the disk is full.
void SpoolFile::into_memory(std::size_t bytes) {
  void* memory = anonymous(bytes);
  std::memcpy(memory, data_, bytes_);
  munmap(data_, bytes_);
  close(file_);
  file_ = -1;
  data_ = memory;
  bytes_ = bytes;
}

void SpoolFile::enter(std::size_t block) const {
  last_block_.store(block, std::memory_order_relaxed);
  // Accesses to the first blocks of the file (most_blocks in number) are not counted. So if a file has no
  // other blocks, its pages are never released, in whatever order they are accessed.
  if (file_ < 0 || block < most_blocks ||
      entered_.fetch_add(1, std::memory_order_relaxed) % most_blocks != most_blocks - 1)
    return;
  madvise(data_, bytes_, MADV_DONTNEED);
}

}  // namespace canhil
