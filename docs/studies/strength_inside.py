# SPDX-License-Identifier: Apache-2.0
"""Strength inside the mass, full stress: both friction cones, and pore pressure inside or at the bed alone.

usage: strength_inside.py STURZ DATA_FOLDER OUT_FOLDER [collapse|pile|slope|s1000[:SPACING_M] ...]   (needs gdal_translate)
`collapse`: V8b, the slice of a column beside its run-out laws. `pile`: a heap steeper than its friction angle, the slope that it comes down to. `slope`: six layers without end on a rough bed around their
friction angle. `s1000`: the landslide of 2021 beside its DEM of difference; DATA_FOLDER/s1000_sthelens holds
pre_runout_DEM.asc, landslide_depth.asc and DEM_of_Difference.asc. Prints tables.
"""
import math
import pathlib
import sys

from erosion_s1000 import centre, layer, read_grid
from runs import run as kept_run

CONES = ("simple_shear", "plane_strain")

COLLAPSE = """
title: Collapse of a slice
terrain: {{synthetic: {{plane: {{cell_size_m: {cell}, slope_deg: 0, length_m: {length}, width_m: {width}}}}}}}
release: {{box: {{x_m: [0, 1], y_m: [-{half}, {half}]}}, thickness_m: {aspect}}}
grains: {{diameter_m: 0.01, {friction}, friction_cone: {cone}}}
basal: {{friction_coefficient: {bed}}}
formulation: full_stress
domain: {{periodic: [y], walls: [{{point_m: [0, 0, 0], normal: [1, 0, 0]}}]}}
numerics: {{spacing_m: {dx}, end_time_s: {end}, accept_unresolved: true}}
hazard: {{cell_size_m: {dx}}}
"""
# Name, internal friction, angle of the bed, run-out over length by aspect ratio a, height over length (docs/physics.md V8b).
GRAINS = (
    ("sand", "friction_angle_deg: 31", 31, lambda a: 1.2 * a if a < 2.3 else 1.9 * a ** (2 / 3), lambda a: a if a < 0.7 else a ** (1 / 3)),
    ("beads", "friction: {}", 27.4, lambda a: 1.67 * a if a < 2.3 else 2.7 * a ** (2 / 3), None),
)

PILE = """
title: Steep pile
terrain: {{synthetic: {{plane: {{cell_size_m: 1, slope_deg: 0, length_m: 60, width_m: 60}}}}}}
release: {{paraboloid: {{center_m: [0, 0], semi_axes_m: [8, 8]}}, thickness_m: 8}}
grains: {{friction_angle_deg: {angle}, friction_cone: {cone}}}
basal: {{friction_coefficient: 0.8}}
formulation: full_stress
numerics: {{spacing_m: {spacing}, end_time_s: 16, stop_at_rest: false}}
hazard: {{cell_size_m: {spacing}}}
"""

SLOPE = """
title: Slope without end
terrain: {{synthetic: {{plane: {{cell_size_m: 2, slope_deg: {slope}, length_m: 12, width_m: 8}}}}}}
release: {{box: {{x_m: [-6, 6], y_m: [-4, 4]}}, thickness_m: 6}}
grains: {{friction_angle_deg: 30, friction_cone: {cone}}}
basal: {{friction_coefficient: 1}}
formulation: full_stress
domain: {{periodic: [x, y]}}
numerics: {{spacing_m: 1, end_time_s: 15, stop_at_rest: false, artificial_viscosity: {viscosity}}}
"""

S1000 = """
title: S-1000
terrain: {{raster: {data}/pre_runout_DEM.asc, crs: "EPSG:32149"}}
release: {{thickness_raster: {data}/landslide_depth.asc, thickness_factor: -1, surface: pre_failure}}
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: {angle}{grains}}}
basal: {{friction_coefficient: {friction}, pore_pressure_ratio: {ratio}}}
formulation: {formulation}
numerics: {{spacing_m: {spacing}, accept_unresolved: true}}
hazard: {{cell_size_m: 10}}
"""


def run(sturz, folder, text):
    """Folder and numbers of one member."""
    return folder / "out", kept_run(sturz, folder, text)


def pile_slope(cells, cell):
    """Mean slope [deg] of the rings' mean thickness between a quarter and three quarters of the height."""
    rings = {}
    mass_x, mass_y = centre(cells)
    for (x, y), h in cells.items():
        rings.setdefault(int(math.hypot(x - mass_x, y - mass_y) / cell), []).append(h)
    profile = [((k + 0.5) * cell, sum(v) / len(v)) for k, v in sorted(rings.items())]
    top = max(h for _, h in profile)
    part = [(r, h) for r, h in profile if 0.25 * top < h < 0.75 * top]
    mean_r, mean_h = sum(r for r, _ in part) / len(part), sum(h for _, h in part) / len(part)
    return math.degrees(math.atan(-sum((r - mean_r) * (h - mean_h) for r, h in part) / sum((r - mean_r) ** 2 for r, _ in part)))


def collapses(sturz, _, out):
    print("| grains | a | along | cone | run-out / L0, contour | law | height / L0 | law |\n|---|---|---|---|---|---|---|---|")
    for name, friction, bed, far, high in GRAINS:
        for aspect, along in ((0.5, 20), (1, 20), (2, 14), (5, 10)):
            for cone in CONES:
                dx = 1 / along
                runout = 2 * dx * math.ceil((1.5 + 3 * aspect) / (2 * dx))
                text = COLLAPSE.format(cell=2 * dx, length=2 * runout, width=4 * dx, half=2 * dx, aspect=aspect, friction=friction, cone=cone,
                                       bed=math.tan(math.radians(bed)), dx=dx, end=8 * math.sqrt(aspect / 9.80665))
                folder, _ = run(sturz, out / f"collapse_{name}_{aspect}_{cone}", text)
                cells, _ = layer(folder, "deposit_thickness")
                strips = {}
                for (x, _), h in cells.items():
                    strips.setdefault(round(x / dx - 0.5), []).append(h)
                mean = {k: sum(v) / len(v) for k, v in strips.items() if k >= 0}
                edge = max(k for k, h in mean.items() if h > 0.5 * dx)
                # Between the last strip over half a spacing and the first under it.
                after = mean.get(edge + 1, 0.0)
                contour = (edge + 0.5 + (mean[edge] - 0.5 * dx) / (mean[edge] - after)) * dx - 1
                top = max(h for k, h in mean.items() if (k + 0.5) * dx < 0.3)
                law = f"{high(aspect):.2f}" if high else ""
                print(f"| {name} | {aspect} | {along} | {cone} | {contour:.2f} | {far(aspect):.2f} | {top:.2f} | {law} |", flush=True)


def piles(sturz, _, out, spacing=0.8):
    print("| friction | cone | spacing m | height m | slope deg | front travel m |\n|---|---|---|---|---|---|")
    for angle in (25, 35):
        for cone in CONES:
            folder, m = run(sturz, out / f"pile_{angle}_{cone}_{spacing}", PILE.format(angle=angle, cone=cone, spacing=spacing))
            cells, cell = layer(folder, "deposit_thickness")
            print(f"| {angle} | {cone} | {spacing} | {m['max_deposit_m']:.2f} | {pile_slope(cells, cell):.1f} | {m['front_travel_m']:.1f} |", flush=True)


def slopes(sturz, _, out):
    """Beside a block on atan(tan phi) and on atan(sin phi): way of the centre after 15 s."""
    def block(slope, friction):
        return max(0.0, 0.5 * 9.81 * 15**2 * (math.sin(slope) - friction * math.cos(slope)) * math.cos(slope))

    print("| slope deg | viscosity | cone | way of the centre m | block of tan 30 m | block of sin 30 m |\n|---|---|---|---|---|---|")
    for slope, viscosity in ((26, 0.1), (28, 0.1), (29, 0.1), (32, 0.1), (32, 0.05)):
        for cone in CONES:
            _, m = run(sturz, out / f"slope_{slope}_{viscosity}_{cone}", SLOPE.format(slope=slope, viscosity=viscosity, cone=cone))
            a = math.radians(slope)
            print(f"| {slope} | {viscosity} | {cone} | {m['com_travel_m']:.2f} | {block(a, math.tan(math.pi / 6)):.1f} | {block(a, 0.5):.1f} |", flush=True)


def s1000(sturz, data, out, spacing=2.25):
    data = pathlib.Path(data).resolve() / "s1000_sthelens"
    depth, cell = read_grid(data / "landslide_depth.asc")
    # Cells of the raster lie where its decimals put them: match them by rounding.
    source = {(round(x), round(y)): -v for (x, y), v in depth.items() if v < 0}
    volume = sum(source.values()) * cell * cell
    difference, _ = read_grid(data / "DEM_of_Difference.asc")
    difference = {(round(x), round(y)): v for (x, y), v in difference.items()}
    stayed = sum(depth + difference[at] for at, depth in source.items()) * cell * cell

    def line(name, deposit, left):
        outside = {at: v for at, v in deposit.items() if at not in source and v > 0.05}
        far = max(math.dist(at, centre(source)) for at in outside)
        print(f"| {name} | {100 * left:.0f} | {far:.0f} | {math.dist(centre(outside), centre(source)):.0f} | {math.dist(centre(deposit), centre(source)):.0f} | "
              f"{max(deposit.values()):.1f} |", flush=True)

    print("| formulation | dx m | angle inside | friction of the bed, r_u | cone | r_u inside | left the source % | farthest deposit cell m | "
          "centre of mass of what left m | of all m | largest deposit m |\n|---|---|---|---|---|---|---|---|---|---|---|")
    observed = {at: v for at, v in difference.items() if v > 0 and at not in source}
    observed.update({at: max(0.0, depth + difference[at]) for at, depth in source.items()})
    line("measured | | | | | ", observed, 1 - stayed / volume)
    # One bed of 0.265 throughout: dry, and as the tangent of the angle inside weakened by its pore pressure.
    wet = {angle: 1 - 0.265 / math.tan(math.radians(angle)) for angle in (32, 25)}
    cases = [("depth_averaged", 32, 0, None, False)]
    for angle in (32, 25):
        cases += [("full_stress", angle, 0, cone, False) for cone in CONES]
        cases += [("full_stress", angle, wet[angle], cone, True) for cone in CONES]
    cases.append(("full_stress", 1, 0, "simple_shear", False))  # next to no strength inside: what the bed alone holds
    for formulation, angle, ratio, cone, inside in cases:
        grains = f", friction_cone: {cone}, pore_pressure_inside: {str(inside).lower()}" if cone else ""
        text = S1000.format(data=data, angle=angle, grains=grains, friction=round(0.265 / (1 - ratio), 4), ratio=round(ratio, 4), formulation=formulation, spacing=spacing)
        folder, _ = run(sturz, out / f"s1000_{formulation}_{spacing}_{angle}_{cone}_{inside}", text)
        deposit, size = layer(folder, "deposit_thickness")
        deposit = {(round(x), round(y)): v for (x, y), v in deposit.items()}
        kept = sum(deposit.get(at, 0.0) for at in source) / sum(deposit.values())
        line(f"{formulation} | {spacing} | {angle} | {0.265 / (1 - ratio):.3f}, {ratio:.2f} | {cone or ''} | {'yes' if inside else ''}", deposit, 1 - kept)


PARTS = {
    "collapse": ("V8b: slices of a column collapse", collapses),
    "pile": ("V9: a heap of 8 m over a radius of 8 m comes down", piles),
    "slope": ("V9: a slope without end, friction 30 degrees, bed rougher", slopes),
    "s1000": ("S-1000", s1000),
}


def main(sturz, data, out, *parts):
    out = pathlib.Path(out)
    for part in parts or ("collapse", "pile", "slope", "s1000:4.5", "s1000:2.25"):
        name, _, spacing = part.partition(":")
        title, measure = PARTS[name]
        print(f"\n### {title}{f', {spacing} m' if spacing else ''}")
        measure(sturz, data, out, *([float(spacing)] if spacing else []))


if __name__ == "__main__":
    main(*sys.argv[1:])
