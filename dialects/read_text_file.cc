#include "dialects/read_text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "base/encoding.h"

namespace ncport::dialects {

Result<FileId> ReadTextFile(std::string_view path, SourceFiles& files, diag::Sink& sink) {
  const std::string name(path);
  const auto refuse = [&](const char* reason) {
    sink.Report(diag::Code::kUnreadableFile, {}, path, reason);
    return Failure{};
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), &std::fclose);
  if (!file) return refuse(std::strerror(errno));
  std::string bytes(kMaxSettingsBytes + 1, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  if (std::ferror(file.get()) != 0) return refuse(std::strerror(errno));
  if (bytes.size() > kMaxSettingsBytes) return refuse("longer than 1 MiB");
  DecodedText decoded = DecodeText(bytes);
  const bool utf8 = decoded.encoding == Encoding::kAscii || decoded.encoding == Encoding::kUtf8 ||
                    decoded.encoding == Encoding::kUtf8Bom;
  if (decoded.is_binary || !utf8) return refuse("it is not UTF-8 text");
  return files.Add(name, std::move(decoded.text));
}

}  // namespace ncport::dialects
