// What is here: which discs of a periodic rectangle may overlap: candidates found by cells, and among them the near
// pairs, laid out as the force loop reads them. What is not: forces (pair_forces.h), the decision when lists are stale
// (overlap_minimiser.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cell_grid.h"

namespace perfora::geometry {

/// Discs that a thread takes in one go, and that a sum runs over: fixed, so that no bit depends on the number of
/// threads. Their forces and displacements stay in the fastest cache.
inline constexpr std::size_t chunk_size = 1024;
/// Pairs in one vector.
inline constexpr int lanes = 8;

struct Place {
  double x = 0.0, y = 0.0;
};

struct Float2 {
  float x = 0.0F, y = 0.0F;
};

/// Eight pairs of a chunk's discs (`first`, counted from the chunk's beginning) with others (`second`). Lanes to spare
/// hold a disc and itself at reach 0, which never overlap.
template <class Index>
struct alignas(32) PairGroup {
  Float2 apart[lanes] = {};  ///< second minus first at the places of the last search, the right periodic image
  float reach[lanes] = {};   ///< sum of the unscaled radii, in the order of lane_of_reach
  std::uint16_t first[lanes] = {};
  Index second[lanes] = {};
};

/// Where the reach of pair k stands: the order in which even and odd lanes come out of two vectors.
inline constexpr int lane_of_reach[lanes] = {0, 1, 4, 5, 2, 3, 6, 7};

template <class Index>
struct PairTable {
  std::vector<PairGroup<Index>> candidates;
  std::vector<PairGroup<Index>> near;  ///< room for all candidates; the first near_groups are in use
  std::size_t near_groups = 0;
};

/// Pairs of one chunk. A pair within the chunk is there once and acts on both; one with a disc of another chunk is in
/// both chunks and acts on the own disc only, so that no chunk writes into another.
struct ChunkPairs {
  PairTable<std::uint16_t> inner;  ///< `second` counted from the chunk's beginning, too
  PairTable<std::int32_t> outer;
};

/// Near pairs are selected from candidates that reach farther: selecting is cheap, searching the cells is not.
class PairLists {
 public:
  PairLists(double width, double height, const std::vector<double>& radius, int threads);

  /// Candidates are all pairs closer than scale times the sum of their radii plus `margin`, each image of a disc for
  /// itself. Brings the places back into the cell.
  void search(std::vector<Place>& places, double scale, double margin);

  /// Near are the candidates closer than scale times the sum of their radii plus `skin`, each disc having moved by
  /// `moved` since the search.
  void select(const std::vector<Float2>& moved, double scale, double skin);

  const ChunkPairs& of_chunk(std::size_t chunk) const { return pairs_[chunk]; }

 private:
  /// A disc and which of its images: the periods to be added to its place.
  struct Image {
    std::int32_t disc;
    std::int8_t periods_x, periods_y;
  };
  struct Surroundings;
  struct Found;

  void gather(const CellGrid& grid, std::size_t cell, double scale, Surroundings& around) const;
  void search_chunk(std::size_t chunk, const CellGrid& grid, double scale, double margin);
  template <class Index>
  void lay_out(const Found& found, std::size_t begin, std::size_t origin, PairTable<Index>& table) const;

  double width_, height_;
  std::vector<double> radius_;
  double largest_radius_ = 0.0;
  bool narrow_ = false;  ///< so small a cell that a disc may meet two images of another
  int threads_;
  std::vector<Place> places_;
  std::vector<ChunkPairs> pairs_;
};

}  // namespace perfora::geometry
