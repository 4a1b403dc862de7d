#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>

#include <list>

#include "base/error.hpp"
#include "base/pending_file.hpp"
#include "base/threads.hpp"
#include "image/exr.hpp"

namespace nook {

namespace {

/// OpenEXR's stream onto a PendingFile, which remembers the first error: OpenEXR writes its line table from a
/// destructor and swallows what goes wrong there, commit() then reports it.
class PendingStream : public Imf::OStream {
 public:
  PendingStream(PendingFile& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int count) override { file_.write(bytes, static_cast<std::size_t>(count)); }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  PendingFile& file_;
};

template <class Value>
Imf::Slice slice_of(Imf::PixelType type, const std::vector<Value>& values, const Image& image) {
  // OpenEXR takes a mutable pointer for reading and writing alike; writing does not modify it.
  char* base = reinterpret_cast<char*>(const_cast<Value*>(values.data()));
  const Imath::V2i origin(image.x0, image.y0);
  return Imf::Slice::Make(type, base, origin, image.width, image.height);
}

void require_planes(const Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.channels.empty())
    throw Error(ErrorKind::internal, fmt::format("write_exr: an image of {} x {} pixels and {} channels",
                                                 image.width, image.height, image.channels.size()));
  for (const Channel& channel : image.channels) {
    const std::size_t size = std::visit([](const auto& values) { return values.size(); }, channel.values);
    if (size != pixels)
      throw Error(ErrorKind::internal, fmt::format("write_exr: channel {} has {} values for {} pixels",
                                                   channel.name, size, pixels));
  }
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image, ExrPrecision precision) {
  require_planes(image);
  // Compression is most of the time spent here, and the bytes do not depend on the number of threads.
  static const bool threads_set = (Imf::setGlobalThreadCount(static_cast<int>(threads_to_use())), true);
  (void)threads_set;

  const Imath::Box2i window({image.x0, image.y0}, {image.x0 + image.width - 1, image.y0 + image.height - 1});
  const Imath::Box2i whole({0, 0}, {image.full_width - 1, image.full_height - 1});
  Imf::Header header(image.full_width > 0 ? whole : window, window);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::list<std::vector<Imath::half>> halves;  // a list: the frame buffer points into its elements
  for (const Channel& channel : image.channels) {
    const char* name = channel.name.c_str();
    const auto* reals = std::get_if<std::vector<float>>(&channel.values);
    if (reals && precision == ExrPrecision::half) {
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      frame.insert(name, slice_of(Imf::HALF, halves.emplace_back(reals->begin(), reals->end()), image));
    } else if (reals) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, slice_of(Imf::FLOAT, *reals, image));
    } else {
      header.channels().insert(name, Imf::Channel(Imf::UINT));
      frame.insert(name, slice_of(Imf::UINT, std::get<std::vector<std::uint32_t>>(channel.values), image));
    }
  }
  for (const auto& [key, value] : image.metadata) header.insert(key.c_str(), Imf::StringAttribute(value));

  PendingFile file(path);
  try {
    PendingStream stream(file, path.string());
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(frame);
    output.writePixels(image.height);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::output, fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
  file.commit();
}

}  // namespace nook
