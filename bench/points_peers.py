# SPDX-License-Identifier: LGPL-2.1-or-later
"""Open3D on the trials of points_success: FPFH features, RANSAC, ICP, as its own tutorial joins them.

    points_success --cases 51 --export DIR
    /usr/bin/python3 bench/points_peers.py DIR [ROW ...]     # Debian's python3-open3d

Success as there: largest distance of the moved noise-free points from the original (from 30 000 points of it)
/ sqrt(area) < 0.01 and the scale within 2 %. With an unknown scale 12 scales from 0.3 to 3 are tried, each refined
with a free scale, and the one with the smallest residual wins.
"""

import sys
import time
from collections import defaultdict
from pathlib import Path

import numpy as np
import open3d as o3d

registration = o3d.pipelines.registration


def prepared(points, voxel):
    """Points with the same density on both sides, and their features."""
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points)).voxel_down_sample(voxel)
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=4 * voxel, max_nn=30))
    cloud.orient_normals_consistent_tangent_plane(15)
    features = registration.compute_fpfh_feature(cloud, o3d.geometry.KDTreeSearchParamHybrid(radius=10 * voxel, max_nn=100))
    return cloud, features


def aligned(suspect, original, original_features, voxel, free_scale):
    cloud, features = prepared(suspect, voxel)
    if len(cloud.points) < 10:
        return None
    rough = registration.registration_ransac_based_on_feature_matching(
        cloud, original, features, original_features, True, 1.5 * voxel,
        registration.TransformationEstimationPointToPoint(False), 3,
        [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
         registration.CorrespondenceCheckerBasedOnDistance(1.5 * voxel)],
        registration.RANSACConvergenceCriteria(100000, 0.999))
    full = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(suspect))
    return registration.registration_icp(
        full, original, 2 * voxel, rough.transformation,
        registration.TransformationEstimationPointToPoint(free_scale))


def trial(place, unknown):
    original, suspect, exact = (np.asarray(o3d.io.read_point_cloud(str(place / name)).points)
                                for name in ("original.ply", "suspect.ply", "exact.ply"))
    truth = np.array([float(word) for word in (place / "truth.txt").read_text().split()])
    scale, size = truth[0], truth[-1]
    voxel = 0.03 * size
    target, target_features = prepared(original, voxel)
    best, best_residual = None, np.inf
    for factor in (np.geomspace(0.3, 3.0, 12) if unknown else [1.0]):
        found = aligned(factor * suspect, target, target_features, voxel, unknown)
        if found is None or found.fitness == 0.0:
            continue
        residual = found.inlier_rmse / factor + (1.0 - found.fitness) * size  # what is not covered counts first
        if residual < best_residual:
            best, best_residual = found.transformation @ np.diag([factor] * 3 + [1.0]), residual
    if best is None:
        return False
    moved = exact @ best[:3, :3].T + best[:3, 3]
    dense = o3d.io.read_point_cloud(str(place.parent / (place.name.split("_")[3] + "_dense.ply")))
    distance = np.asarray(o3d.geometry.PointCloud(o3d.utility.Vector3dVector(moved)).compute_point_cloud_distance(dense))
    found_scale = np.cbrt(np.linalg.det(best[:3, :3]))
    return distance.max() / size < 0.01 and abs(found_scale / scale - 1.0) < 0.02


def main(folder, wanted):
    o3d.utility.random.seed(0)
    cells = defaultdict(list)
    for place in sorted(path for path in Path(folder).iterdir() if path.is_dir()):
        row, scale, coverage = place.name.split("_")[:3]
        if wanted and f"{row}_{scale}" not in wanted:
            continue
        start = time.process_time()
        success = trial(place, scale == "free")
        cells[row, scale, float(coverage)].append((success, time.process_time() - start))
    for (row, scale, coverage), results in sorted(cells.items(), key=lambda cell: (cell[0][:2], -cell[0][2])):
        success, seconds = zip(*results)
        print(f"{row} scale {scale:5} {100 * coverage:4.0f} %  success {100 * np.mean(success):5.1f} % of {len(results)}"
              f"  median {np.median(seconds):.2f} s")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
