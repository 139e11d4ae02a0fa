# SPDX-License-Identifier: LGPL-2.1-or-later
"""Open3D on the trials of points_success, as its own tutorials join its parts:

    ransac   FPFH features, RANSAC over their matches, ICP
    fgr      FPFH features, fast global registration, ICP
    icp      ICP alone, from centroids laid on each other

    points_success --cases 30 --export DIR
    /usr/bin/python3 bench/points_peers.py DIR [ROW ...]     # Debian's python3-open3d; ROW e.g. noise0.001_free

Success as there: largest distance of the moved noise-free points from the original (from 30 000 points of it)
/ sqrt(area) < 0.01 and the scale within 2 %. With an unknown scale 12 scales from 0.3 to 3 are tried, each refined
with a free scale, and the one with the smallest residual wins. One thread, processor time.
"""

import os
import sys
import time
from collections import defaultdict
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import open3d as o3d

registration = o3d.pipelines.registration

SCALES = np.geomspace(0.3, 3.0, 12)
VOXEL = 0.02  # of sqrt(area): 3000 points of a surface are as far apart


def cloud_of(points):
    return o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))


def prepared(points, voxel, turn_normals=False):
    """Points with the same density on both sides, and their features."""
    cloud = cloud_of(points).voxel_down_sample(voxel)
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=4 * voxel, max_nn=60))
    if len(cloud.points) > 15:
        cloud.orient_normals_consistent_tangent_plane(15)
    if turn_normals:
        cloud.normals = o3d.utility.Vector3dVector(-np.asarray(cloud.normals))
    features = registration.compute_fpfh_feature(
        cloud, o3d.geometry.KDTreeSearchParamHybrid(radius=10 * voxel, max_nn=400))
    return cloud, features


def both_sides(register):
    """Rough poses: which side of a cloud is outside is not known, and features depend on it."""

    def poses(suspect, original, voxel):
        for turn_normals in (False, True):
            cloud, features = prepared(suspect, voxel, turn_normals)
            if len(cloud.points) < 10:
                continue
            try:
                yield register(cloud, features, *original, voxel).transformation
            except RuntimeError:  # Open3D refuses where no features correspond, as with a wrong scale
                continue

    poses.__name__ = register.__name__
    return poses


@both_sides
def ransac(cloud, features, target, target_features, voxel):
    return registration.registration_ransac_based_on_feature_matching(
        cloud, target, features, target_features, False, 1.5 * voxel,
        registration.TransformationEstimationPointToPoint(False), 3,
        [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
         registration.CorrespondenceCheckerBasedOnDistance(1.5 * voxel)],
        registration.RANSACConvergenceCriteria(100000, 0.999))


@both_sides
def fgr(cloud, features, target, target_features, voxel):
    return registration.registration_fgr_based_on_feature_matching(
        cloud, target, features, target_features,
        registration.FastGlobalRegistrationOption(maximum_correspondence_distance=1.5 * voxel))


def icp(suspect, original, voxel):
    start = np.eye(4)
    start[:3, 3] = np.asarray(original[0].points).mean(axis=0) - suspect.mean(axis=0)
    yield start


METHODS = (ransac, fgr, icp)


def aligned(suspect, target, voxel, size, rough, unknown):
    """The best similarity over the scales: rough poses, each refined by ICP with every point."""
    best, best_residual = None, np.inf
    # Point to plane is the more exact, but leaves the scale as it is.
    estimation = (registration.TransformationEstimationPointToPoint(True) if unknown
                  else registration.TransformationEstimationPointToPlane())
    reach = 2 * voxel if rough is not icp else size  # ICP alone pairs every point, however far
    for factor in SCALES if unknown else [1.0]:
        scaled = factor * suspect
        for start in rough(scaled, target, voxel):
            found = registration.registration_icp(cloud_of(scaled), target[0], reach, start, estimation,
                                                  registration.ICPConvergenceCriteria(max_iteration=100))
            if found.fitness == 0.0:
                continue
            scale = factor * np.cbrt(np.linalg.det(found.transformation[:3, :3]))
            residual = (found.inlier_rmse + (1.0 - found.fitness) * size) / scale  # in the suspect's unit
            if residual < best_residual:
                best, best_residual = found.transformation @ np.diag([factor] * 3 + [1.0]), residual
    return best


def succeeds(found, place, exact, scale, size):
    if found is None:
        return False
    moved = exact @ found[:3, :3].T + found[:3, 3]
    dense = o3d.io.read_point_cloud(str(place.parent / (place.name.split("_")[3] + "_dense.ply")))
    distance = np.asarray(cloud_of(moved).compute_point_cloud_distance(dense))
    return distance.max() / size < 0.01 and abs(np.cbrt(np.linalg.det(found[:3, :3])) / scale - 1.0) < 0.02


def trial(place, unknown):
    """For each method whether it succeeded, and its seconds."""
    original, suspect, exact = (np.asarray(o3d.io.read_point_cloud(str(place / name)).points)
                                for name in ("original.ply", "suspect.ply", "exact.ply"))
    truth = np.array([float(word) for word in (place / "truth.txt").read_text().split()])
    scale, size = truth[0], truth[-1]
    target = prepared(original, VOXEL * size)
    results = {}
    for method in METHODS:
        start = time.process_time()
        found = aligned(suspect, target, VOXEL * size, size, method, unknown)
        seconds = time.process_time() - start
        results[method.__name__] = (succeeds(found, place, exact, scale, size), seconds)
    return results


def main(folder, wanted):
    o3d.utility.set_verbosity_level(o3d.utility.VerbosityLevel.Error)
    o3d.utility.random.seed(0)
    cells = defaultdict(list)
    for place in sorted(path for path in Path(folder).iterdir() if path.is_dir()):
        row, scale, coverage = place.name.split("_")[:3]
        if not wanted or f"{row}_{scale}" in wanted:
            cells[row, scale, float(coverage)].append(place)
    print(f"{'row':<16} {'scale':<6} {'cover':>6} {'cases':>6}"
          + "".join(f" {method.__name__ + ' %':>10} {'s':>7}" for method in METHODS))
    for (row, scale, coverage), places in sorted(cells.items(), key=lambda cell: (cell[0][:2], -cell[0][2])):
        results = [trial(place, scale == "free") for place in places]
        text = f"{row:<16} {scale:<6} {100 * coverage:5.0f}% {len(places):6d}"
        for method in METHODS:
            success, seconds = zip(*(result[method.__name__] for result in results))
            text += f" {100 * np.mean(success):10.1f} {np.median(seconds):7.2f}"
        print(text, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
