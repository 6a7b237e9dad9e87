// Prints docs/profiles.md. With --check: only looks at every built-in profile, so that a broken one breaks the build.
#include <cstdio>
#include <string_view>

#include "dialects/profile_keys.h"
#include "dialects/registry.h"

int main(int argc, char** argv) {
  const std::string page = ncport::dialects::ProfilePage();  // loads each profile; a finding in one ends with exit 70
  if (argc > 1 && std::string_view(argv[1]) == "--check") return 0;
  std::fwrite(page.data(), 1, page.size(), stdout);
  return 0;
}
