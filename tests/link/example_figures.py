"""Runs the built examples, prints what they print, and checks what they promise: example_figures.py FOLDERS

FOLDERS is what the build folders' paths begin with; the name of the example follows. Relations are asserted, with room
where a mesher or a solver has its luck, not digits.
"""

import os
import re
import subprocess
import sys

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def output_of(*command):
    # OpenMPI refuses to run for root, and to start more processes than there are cores, unless told so.
    permissions = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env={**os.environ, **permissions})
    print(done.stdout, end="")
    if done.returncode:
        sys.exit(f"{command} ended with {done.returncode}\n{done.stderr}")
    return done.stdout


def figures(text):
    """For each line the figures behind its name, which ends with the first colon."""
    lines = (line.split(":", 1) for line in text.splitlines() if ":" in line)
    return {name: [float(number) for number in NUMBER.findall(rest)] for name, rest in lines}


def check(condition, promise):
    if not condition:
        sys.exit(f"not so: {promise}")


def check_gmsh(folder):
    said = figures(output_of(f"{folder}/gmsh_volume"))
    # triangles, least angle, triangles below 30 (the 30 itself comes first), edge_ratio mean and max, faults
    _, angle, _, few, ratio, _, _ = said["surface without"]
    _, better_angle, _, fewer, better_ratio, _, faults = said["surface with"]
    check(better_angle > max(25, angle + 5) and fewer < few, "the worst angle of the surface is better")
    check(better_ratio < 0.95 * ratio, "the triangles of the surface are rounder")
    check(faults == 0, "the surface is closed")
    # tetrahedra, least dihedral angle, those below 20, mean ratio min and mean
    count, _, _, bad, _, quality = said["volume without"]
    better_count, _, _, better_bad, _, better_quality = said["volume with"]
    check(better_bad / better_count < 0.9 * bad / count, "fewer tetrahedra have small angles")
    check(better_quality > quality + 0.01, "tetrahedra are rounder")


def check_cgal(folder):
    said = figures(output_of(f"{folder}/cgal_properties"))
    check(said["after"][2] > 15 > 1 > said["before"][2], "the worst angle is better")
    valid, border, inside, strayed = said["properties"]
    check(valid == 1, "the mesh is valid")
    check(border < 1e-6, "vertices that stay have their own texture coordinates")
    check(0 < inside < 0.3, "vertices that move have moved no further than their neighbours were")
    check(strayed == 0, "faces have the material of where they are")


def check_poisson(folder):
    said = figures(output_of(f"{folder}/poisson"))
    # vertices, least angle, iterations plain and preconditioned, error in L2
    for mesh, share in (("graded", 1.02), ("scattered", 0.5)):
        _, _, plain, preconditioned, error = said[f"{mesh} before"]
        _, _, better_plain, better_preconditioned, better_error = said[f"{mesh} after"]
        check(better_plain <= share * plain, f"conjugate gradients take fewer steps on the {mesh} mesh")
        check(better_preconditioned <= max(share, 0.7) * preconditioned, f"and preconditioned on the {mesh} mesh")
        check(better_error <= 1.02 * error, f"the error on the {mesh} mesh is no larger")
    check(said["scattered after"][4] < 0.6 * said["scattered before"][4], "the error on the scattered mesh is smaller")


def check_mpi(folder):
    bits = set()
    for ranks in (1, 2, 4):
        text = output_of("mpirun", "--oversubscribe", "-n", str(ranks), f"{folder}/mpi_parts", "4")
        check(f"ranks {ranks}, parts 4:" in text, f"{ranks} processes have run")
        check("the same as one process" in text, f"{ranks} processes give the bits of one")
        bits.add(re.search(r"bits ([0-9a-f]{16})", text).group(1))
        before, after = re.search(r"angle min (\S+) -> (\S+),", text).groups()
        check(float(after) > 10 > 1 > float(before), "the worst angle is better")
    check(len(bits) == 1, "any number of processes gives the same bits")
    # Without an interface and with a large one.
    output_of("mpirun", "--oversubscribe", "-n", "2", f"{folder}/mpi_parts", "2")
    output_of("mpirun", "--oversubscribe", "-n", "4", f"{folder}/mpi_parts", "16")


def main():
    for name, check_example in (
        ("gmsh", check_gmsh),
        ("cgal", check_cgal),
        ("poisson", check_poisson),
        ("mpi", check_mpi),
    ):
        print(f"   {name}")
        check_example(sys.argv[1] + name)


main()
