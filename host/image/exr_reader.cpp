#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "image/exr.hpp"
#include "image/exr_header.hpp"

namespace nook {

namespace {

Imf::Header read_header(const std::filesystem::path& path, int version) {
  Imf::StdIFStream stream(path.c_str());
  stream.seekg(8);  // the magic number and the version
  Imf::Header header;
  header.readFrom(stream, version);
  header.sanityCheck(Imf::isTiled(version));
  return header;
}

std::map<std::string, std::string> texts_of(const Imf::Header& header) {
  std::map<std::string, std::string> texts;
  for (auto i = header.begin(); i != header.end(); ++i)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      texts.emplace(i.name(), text->value());
  return texts;
}

Image read_checked(const std::filesystem::path& path) {
  const int version = check_exr_layout(path);
  check_exr_size(path, read_header(path, version));

  Imf::InputFile file(path.c_str());
  const Imath::Box2i& window = file.header().dataWindow();
  Image image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  const Imath::Box2i& display = file.header().displayWindow();
  if (display != window) {
    image.x0 = window.min.x - display.min.x;
    image.y0 = window.min.y - display.min.y;
    image.full_width = display.max.x - display.min.x + 1;
    image.full_height = display.max.y - display.min.y + 1;
  }
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);

  const Imf::ChannelList& channels = file.header().channels();
  for (auto i = channels.begin(); i != channels.end(); ++i) {
    Channel& channel = image.channels.emplace_back();
    channel.name = i.name();
    if (i.channel().type == Imf::UINT)
      channel.values = std::vector<std::uint32_t>(pixels);
    else
      channel.values = std::vector<float>(pixels);
  }
  Imf::FrameBuffer frame;
  for (Channel& channel : image.channels) {
    const bool integer = std::holds_alternative<std::vector<std::uint32_t>>(channel.values);
    void* data = std::visit([](auto& values) { return static_cast<void*>(values.data()); }, channel.values);
    frame.insert(channel.name, Imf::Slice::Make(integer ? Imf::UINT : Imf::FLOAT, data, window));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);

  image.metadata = texts_of(file.header());
  return image;
}

// Every failure as one line.
template <class Read>
auto reading(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::scene,
                fmt::format("cannot read {}: not enough memory for its pixels", path.string()));
  } catch (const std::exception& error) {
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ErrorKind::scene, fmt::format("cannot read {}: {}", path.string(), reason));
  }
}

}  // namespace

Image read_exr(const std::filesystem::path& path) {
  return reading(path, [&] { return read_checked(path); });
}

std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path) {
  return reading(path, [&] { return texts_of(read_header(path, check_exr_layout(path))); });
}

}  // namespace nook
