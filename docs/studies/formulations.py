# SPDX-License-Identifier: Apache-2.0
"""Columns and full stress on the same scenes: a table, and deposits of both over what was reached.

usage: formulations.py STURZ DATA_FOLDER OUT_FOLDER [PICTURE.png]   (needs python3-numpy, python3-gdal; python3-matplotlib for the picture)
DATA_FOLDER/s1000_sthelens holds pre_runout_DEM.asc and landslide_depth.asc; OUT_FOLDER takes the runs. One thread, every uncertain
value fixed; seconds are processor time of the member.
"""
import pathlib
import sys

import numpy as np
from osgeo import gdal
from runs import run

gdal.UseExceptions()
SCENES = {
    "zhangjiawan": """
terrain: {{synthetic: {{zhangjiawan: {{cell_size_m: 5}}}}}}
release: {{volume_m3: 491000}}
grains: {{density_kg_m3: 2400, diameter_m: 3, solid_fraction: 0.70, friction_angle_deg: 24, cohesion_pa: 5000}}
""",
    "shuicheng": """
terrain: {{synthetic: {{shuicheng: {{cell_size_m: 5}}}}}}
release: {{volume_m3: 700000}}
grains: {{density_kg_m3: 2800, diameter_m: 0.3, solid_fraction: 0.60, friction: {{static: 0.38, dynamic: 0.64, inertial_number_scale: 0.3}}}}
""",
    "s1000": """
terrain: {{raster: {data}/pre_runout_DEM.asc, crs: "EPSG:32149"}}
release: {{thickness_raster: {data}/landslide_depth.asc, thickness_factor: -1, surface: pre_failure}}
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 32}}
""",
}
RUN = """basal: {{friction_coefficient: {friction}, pore_pressure_ratio: {ratio}}}
formulation: {formulation}
numerics: {{spacing_m: {spacing}, end_time_s: 120, accept_unresolved: true}}
hazard: {{cell_size_m: 10}}
"""
# Name, scene, friction, pore pressure ratio, spacings of columns, of full stress [m].
ROWS = [
    ("Zhangjiawan-like, friction 0.24", "zhangjiawan", 0.24, 0, (8, 4, 2.5), (12, 6, 4)),
    ("the same, friction 0.30, r_u 0.2", "zhangjiawan", 0.30, 0.2, (4,), (6,)),
    ("Shuicheng-like dry, friction 0.5", "shuicheng", 0.5, 0, (8, 4, 2.5), (9, 4.5, 3)),
    ("the same, r_u 0.3", "shuicheng", 0.5, 0.3, (4,), (4.5,)),
    ("S-1000, friction 0.25", "s1000", 0.25, 0, (4, 2, 1.2), (4.5, 2.25, 1.5)),
    ("friction 0.30", "s1000", 0.30, 0, (2,), (2.25,)),
    ("friction 0.35", "s1000", 0.35, 0, (2,), (2.25,)),
]
DRAWN = (("Zhangjiawan-like", "zhangjiawan_0.24_0", 4, 4), ("Shuicheng-like dry", "shuicheng_0.5_0", 4, 4.5), ("S-1000", "s1000_0.25_0", 2, 2.25))
FORMULATIONS = {"columns": "depth_averaged", "full stress": "full_stress"}


def folder_of(out, scene, name, spacing):
    return out / f"{scene}_{name.replace(' ', '_')}_{spacing}"


def table(sturz, data, out):
    print("| scene | formulation | dx m | particles | layers, release | layers, moving | run-out m | centre of mass m | reached ha | deposit ha | largest deposit m |"
          " largest speed m/s | largest energy MJ/m² | steps | s |\n|" + "---|" * 15)
    for title, scene, friction, ratio, *spacings in ROWS:
        for name, series in zip(FORMULATIONS, spacings):
            for spacing in series:
                text = f"title: {title}" + (SCENES[scene] + RUN).format(data=data, friction=friction, ratio=ratio, formulation=FORMULATIONS[name], spacing=spacing)
                s = run(sturz, folder_of(out, f"{scene}_{friction}_{ratio}", name, spacing), text)
                print(f"| {title} | {name} | {spacing} | {s['n_particles']:,.0f} | {s['release_layers']:.1f} | {s['layers_median']:.1f} | {s['runout_m']:,.0f} | "
                      f"{s['com_travel_m']:.0f} | {s['reached_area_m2'] / 1e4:.1f} | {s['deposit_area_m2'] / 1e4:.1f} | {s['max_deposit_m']:.1f} | {s['max_speed_m_s']:.0f} | "
                      f"{s['max_energy_j_m2'] / 1e6:.1f} | {s['n_steps']:,.0f} | {s['cpu_s']:.2g} |", flush=True)


def layer(folder, name):
    data = gdal.Open(f'NETCDF:"{folder}/out/peaks.nc":{name}')
    _, cell, *_ = data.GetGeoTransform()
    z = data.ReadAsArray().astype(float)
    return np.where(z > 1e30, np.nan, z), cell


def draw(axis, title, folder):
    reached, cell = layer(folder, "peak_thickness")
    deposit, _ = layer(folder, "deposit_thickness")
    rows, columns = np.where(reached > 0.05)
    extent = [0, cell * reached.shape[1], 0, cell * reached.shape[0]]
    axis.imshow(np.where(reached > 0.05, 0.3, np.nan), extent=extent, cmap="Greys", vmin=0, vmax=1)
    image = axis.imshow(np.where(deposit > 0.05, deposit, np.nan), extent=extent, cmap="YlOrBr", vmin=0, vmax=12)
    axis.set_xlim(columns.min() * cell - 60, columns.max() * cell + 60)
    axis.set_ylim(extent[3] - rows.max() * cell - 60, extent[3] - rows.min() * cell + 60)
    axis.set_title(title, fontsize=8)
    axis.set_aspect("equal")
    axis.tick_params(labelsize=6)
    return image


def picture(out, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(len(DRAWN), 2, figsize=(11, 2.6 * len(DRAWN)), squeeze=False)
    for row, (title, scene, *spacings) in zip(axes, DRAWN):
        for axis, name, spacing in zip(row, FORMULATIONS, spacings):
            image = draw(axis, f"{title}, {name} {spacing} m", folder_of(out, scene, name, spacing))
    figure.colorbar(image, ax=axes, shrink=0.6, label="deposit [m]; grey: reached at any time")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def main(sturz, data, out, path=None):
    out = pathlib.Path(out)
    table(sturz, pathlib.Path(data).resolve() / "s1000_sthelens", out)
    if path:
        picture(out, path)


if __name__ == "__main__":
    main(*sys.argv[1:])
