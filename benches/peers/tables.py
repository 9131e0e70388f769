"""Figures as Markdown tables: one a mesh, one of ratios."""

OURS = "qsmesh"
COLUMNS = (
    "| | ns, whole | ns, call alone | ns, marginal "
    "| edge_ratio mean | variance | smallest angle | volume | deviation |"
)
RATIO_PEERS = [
    "OpenMesh tangential",
    "CGAL tangential_relaxation",
    "CGAL angle smoothing",
    "CGAL angle smoothing, projected",
    "MeshLab Laplacian",
    "VTK Laplacian",
    "VTK Laplacian, projected",
    "VTK constrained",
    "trueform Laplacian",
    "plain Laplacian, flat arrays",
    "qsmesh, features off",
    "qsmesh, all threads",
]


def document(results):
    return "\n\n".join([ratios(results), *(mesh(name, result) for name, result in results.items())])


def ratios(results):
    """How many times longer than qsmesh's defaults on one thread."""
    head = "| time over that of `qsmesh` (in brackets: ready halfedges) | " + " | ".join(results) + " |"
    rows = [head, "|---" * (len(results) + 1) + "|"]
    for peer in RATIO_PEERS:
        cells = (ratio(result["peers"], peer) for result in results.values())
        rows.append(f"| {peer} | " + " | ".join(cells) + " |")
    return "\n".join(rows)


def ratio(peers, name):
    ours, whole, call = peers[OURS]["whole"], peers[name]["whole"], peers[name]["call"]
    return f"{whole / ours:.2f}" + (f" ({call / ours:.2f})" if whole > 1.01 * call else "")


def mesh(name, result):
    title = f"**{name}**, {result['vertices']:,} vertices, {result['triangles']:,} triangles"
    rows = [title, "", COLUMNS, "|---" * 9 + "|"]
    rows.append(row("before", result["before"]))
    fastest = sorted(result["peers"].items(), key=lambda item: item[1]["whole"])
    rows += [row(peer, figures) for peer, figures in fastest]
    return "\n".join(rows)


def row(name, figures):
    speed = [f"{figures[key]:,.0f}" if key in figures else "" for key in ("whole", "call", "marginal")]
    volume, deviation = figures["volume"], figures["deviation"]
    judged = [
        f"{figures['mean']:.3f}",
        f"{figures['variance']:.3g}",
        f"{figures['smallest angle']:.2f}°",
        "–" if volume is None else f"{volume + 0.0:.1e}",
        "–" if deviation is None else f"{deviation:.4f}",
    ]
    return "| " + " | ".join([name, *speed, *judged]) + " |"
