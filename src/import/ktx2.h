// KTX 2.0 pictures (Khronos specification 2.0.4): ETC1S with BasisLZ and UASTC, as KHR_texture_basisu has them, and
// plain texels of 8 bits a channel; the last two also with Zstandard. Only the first picture of the largest level is
// read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace roomlight::importers {

enum class Ktx2Coding : uint8_t {
  Plain,
  Uastc,
  BasisLz,
};

struct Ktx2Header {
  int width = 0, height = 0;
  Ktx2Coding coding = Ktx2Coding::Plain;
  bool zstandard = false;
  int channels = 4;        // of plain texels
  bool blueFirst = false;  // of plain texels
  uint64_t images = 1;     // of all levels, layers, faces and slices
  std::span<const uint8_t> level, global;  // of the file
};

bool isKtx2(std::span<const uint8_t> bytes);

// What this file holds where it cannot be decoded here, "KTX2 (format 145)"; none where it can, or is too damaged to
// tell.
std::optional<std::string> undecodableKtx2(std::span<const uint8_t> bytes);

// Throws Failure where the header is damaged or points outside the file.
Ktx2Header readKtx2Header(std::span<const uint8_t> bytes);

// RGBA texels, rows from the top; takes memory for width x height texels, which the caller has judged. Throws Failure.
std::vector<uint8_t> decodeKtx2(const Ktx2Header& header);

// The two codings. `blocks`: 16 bytes for each 4 x 4 texels.
void decodeUastc(std::span<const uint8_t> blocks, int width, int height, std::span<uint8_t> rgba);
void decodeBasisLz(const Ktx2Header& header, std::span<uint8_t> rgba);

}  // namespace roomlight::importers
