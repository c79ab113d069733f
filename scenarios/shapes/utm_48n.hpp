// SPDX-License-Identifier: Apache-2.0
/// EPSG:32648 (WGS 84 / UTM zone 48N) as WKT2 text, so that scenarios need no projection library.
#pragma once

namespace sturz::shapes {

inline constexpr const char* utm_48n_wkt =
    R"w(PROJCRS["WGS 84 / UTM zone 48N",BASEGEOGCRS["WGS 84",)w"
    R"w(DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563,)w"
    R"w(LENGTHUNIT["metre",1]]],PRIMEM["Greenwich",0,)w"
    R"w(ANGLEUNIT["degree",0.0174532925199433]],ID["EPSG",4326]],CONVERSION["UTM zone 48N",)w"
    R"w(METHOD["Transverse Mercator",ID["EPSG",9807]],)w"
    R"w(PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433],)w"
    R"w(ID["EPSG",8801]],PARAMETER["Longitude of natural origin",105,ANGLEUNIT["degree",)w"
    R"w(0.0174532925199433],ID["EPSG",8802]],PARAMETER["Scale factor at natural origin",)w"
    R"w(0.9996,SCALEUNIT["unity",1],ID["EPSG",8805]],PARAMETER["False easting",500000,)w"
    R"w(LENGTHUNIT["metre",1],ID["EPSG",8806]],PARAMETER["False northing",0,)w"
    R"w(LENGTHUNIT["metre",1],ID["EPSG",8807]]],CS[Cartesian,2],AXIS["(E)",east,ORDER[1],)w"
    R"w(LENGTHUNIT["metre",1]],AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]],ID["EPSG",)w"
    R"w(32648]])w";

}  // namespace sturz::shapes
