// The practical limit for `flatten` on plain blocks: one hand-written pass that reads literal
// address-value words, keeps the modal axis state, and writes every block again in a normal form.
// It knows no dialect, no variables, no control flow and reports no errors: nothing that does the
// real job can be much faster, so `ncport flatten` is measured as a ratio against it in the same run.
//
//   g++ -O3 -march=native -std=c++20 limit_flatten.cpp -o limit_flatten
//   ./limit_flatten plain.nc > out.nc
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

// Writes value with at most three decimals and no trailing zeros; returns the new end.
char* put_number(char* out, double value) {
  std::int64_t scaled = static_cast<std::int64_t>(value * 1000.0 + (value < 0 ? -0.5 : 0.5));
  if (scaled < 0) {
    *out++ = '-';
    scaled = -scaled;
  }
  out = std::to_chars(out, out + 20, scaled / 1000).ptr;
  int frac = static_cast<int>(scaled % 1000);
  *out++ = '.';
  if (frac) {
    *out++ = static_cast<char>('0' + frac / 100);
    if (frac % 100) {
      *out++ = static_cast<char>('0' + frac / 10 % 10);
      if (frac % 10) *out++ = static_cast<char>('0' + frac % 10);
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: limit_flatten FILE\n");
    return 2;
  }
  int fd = open(argv[1], O_RDONLY);
  struct stat info {};
  if (fd < 0 || fstat(fd, &info) != 0) {
    std::perror(argv[1]);
    return 1;
  }
  auto size = static_cast<std::size_t>(info.st_size);
  auto* text = static_cast<const char*>(mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0));
  madvise(const_cast<char*>(text), size, MADV_SEQUENTIAL);
  constexpr std::size_t kBuffer = 1 << 16;
  static char buffer[kBuffer + 1024];
  char* out = buffer;
  double state[26] = {};
  const char *p = text, *end = text + size;
  while (p < end) {
    char c = *p++;
    if (c == '\n') {
      *out++ = '\n';
      if (out - buffer > static_cast<std::ptrdiff_t>(kBuffer)) {
        if (write(1, buffer, static_cast<std::size_t>(out - buffer)) < 0) return 1;
        out = buffer;
      }
      continue;
    }
    if (c < 'A' || c > 'Z') continue;
    bool negative = false;
    if (p < end && *p == '-') {
      negative = true;
      ++p;
    }
    std::int64_t mantissa = 0;
    int decimals = 0;
    while (p < end && *p >= '0' && *p <= '9') mantissa = mantissa * 10 + (*p++ - '0');
    if (p < end && *p == '.') {
      ++p;
      while (p < end && *p >= '0' && *p <= '9') {
        mantissa = mantissa * 10 + (*p++ - '0');
        ++decimals;
      }
    }
    static constexpr double kScale[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
    double value = static_cast<double>(mantissa) / kScale[decimals];
    if (negative) value = -value;
    state[c - 'A'] = value;
    if (c == 'N') continue;
    if (out != buffer && out[-1] != '\n') *out++ = ' ';
    *out++ = c;
    if (c == 'G' || c == 'M' || c == 'T')
      out = std::to_chars(out, out + 20, static_cast<int>(value)).ptr;
    else
      out = put_number(out, value);
  }
  double sum = 0;
  for (double v : state) sum += v;
  if (write(1, buffer, static_cast<std::size_t>(out - buffer)) < 0) return 1;
  std::fprintf(stderr, "%g\n", sum);
}
