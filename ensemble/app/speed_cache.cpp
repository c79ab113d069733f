// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/speed_cache.hpp"

#include <cstdlib>

namespace sturz::app {

workflow::SpeedCache speed_cache(bool measure_again) {
  using Path = std::filesystem::path;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return {Path(cache) / "sturz" / "speed.json", measure_again};
  if (const char* home = std::getenv("HOME"); home && *home)
    return {Path(home) / ".cache" / "sturz" / "speed.json", measure_again};
  return {{}, measure_again};
}

}  // namespace sturz::app
