// Large pages for what an entry has in memory.
#ifndef MEDIANT_GPPC_PAGES_HPP
#define MEDIANT_GPPC_PAGES_HPP

#ifdef __linux__
#include <sys/mman.h>

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#endif

namespace entry {

// Asks the system to put the memory that is in use into large pages, where it has them. A query reads here
// and there in up to 100 MB of labels, and to find a small page takes as long as to read it. A system that
// will not leaves all as it is.
inline void use_large_pages() {
#ifdef __linux__
  constexpr std::uintptr_t LARGE = std::uintptr_t{2} << 20;
  // MADV_COLLAPSE, which older headers lack.
  constexpr int COLLAPSE = 25;
  std::ifstream areas("/proc/self/maps");
  for (std::string line; std::getline(areas, line);) {
    std::uintptr_t begin = 0, end = 0;
    std::uint64_t file = 0;
    char access[5] = {};
    int read = std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %4s %*s %*s %" SCNu64, &begin, &end,
                           access, &file);
    begin = (begin + LARGE - 1) / LARGE * LARGE;
    end = end / LARGE * LARGE;
    // Memory of the program's own, of no file.
    if (read == 4 && std::string(access) == "rw-p" && file == 0 && begin < end) {
      void *area = reinterpret_cast<void *>(begin);
      madvise(area, end - begin, MADV_HUGEPAGE);
      // At once, from Linux 6.1 on; else the system does it while the program runs.
      madvise(area, end - begin, COLLAPSE);
    }
  }
#endif
}

} // namespace entry

#endif
