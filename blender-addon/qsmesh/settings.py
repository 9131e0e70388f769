# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of the operators, and how the redo panel shows them. Defaults and ranges are the library's."""

from math import radians

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

AXES = [
    ("X", "X", "Across the plane of the object's Y and Z axes"),
    ("Y", "Y", "Across the plane of the object's X and Z axes"),
    ("Z", "Z", "Across the plane of the object's X and Y axes"),
]


class RegionSettings:
    """What may move."""

    selected_only: BoolProperty(
        name="Selected Only", default=True, description="In Edit Mode, move selected vertices alone"
    )
    vertex_group: StringProperty(
        name="Vertex Group", options={"SKIP_SAVE"},
        description="Move only vertices that have a weight of at least 0.5 in this group",
    )
    invert_vertex_group: BoolProperty(
        name="Invert", description="Move only vertices whose weight in the group is below 0.5"
    )


class FeatureSettings:
    """What is kept."""

    use_features: BoolProperty(
        name="Sharp Angles", default=True, description="Keep edges that are creases by the angle between their faces"
    )
    feature_angle: FloatProperty(
        name="Angle", subtype="ANGLE", default=radians(30), min=radians(0.1), max=radians(179.9),
        description="Edges at which the surface turns by more than this may be creases",
    )
    keep_sharp: BoolProperty(name="Sharp Edges", default=True, description="Keep edges that are marked sharp")
    keep_seams: BoolProperty(name="Seams", default=True, description="Keep edges that are marked as seams")
    keep_creases: BoolProperty(name="Creases", default=True, description="Keep edges with a subdivision crease")
    keep_materials: BoolProperty(name="Materials", default=True, description="Keep edges between two materials")
    keep_uv_borders: BoolProperty(
        name="UV Borders", default=True, description="Keep edges along which a UV map is cut"
    )
    boundary: EnumProperty(
        name="Boundary", default="FIXED", description="Vertices on the border of an open mesh",
        items=[
            ("FIXED", "Fixed", "They stay where they are"),
            ("SLIDE", "Slide", "They slide along the border; its corners stay"),
        ],
    )


class MethodSettings:
    """How the triangles are made better."""

    iterations: IntProperty(
        name="Iterations", default=2, min=0, max=10000, soft_max=20, description="Sweeps over the mesh"
    )
    relaxation: FloatProperty(
        name="Relaxation", default=1.2, min=0.01, max=2, description="Factor of each move; 1 goes just to the target"
    )
    quality_floor: FloatProperty(
        name="Quality Floor", subtype="FACTOR", default=0.5, min=0, max=1,
        description="No move makes the worst triangle around a vertex worse below this shape "
        "(0 has no area, 1 is equilateral)",
    )
    use_max_deviation: BoolProperty(name="Limit Deviation", description="Bound how far vertices may leave the surface")
    max_deviation: FloatProperty(
        name="Distance", subtype="DISTANCE", default=0.01, min=0, precision=4,
        description="Greatest distance of a vertex from the original surface, in the scene",
    )
    method: EnumProperty(
        name="Method", default="QUASI_STATISTICAL", description="What the triangles around a vertex want",
        items=[
            ("QUASI_STATISTICAL", "Quasi-Statistical", "The mean of forms modelled from their own statistics"),
            ("LAPLACIAN", "Laplacian", "The mean of the vertices around; the volume changes. For comparison"),
            ("TANGENTIAL_LAPLACIAN", "Tangential Laplacian", "The part of the Laplacian step that keeps the volume"),
        ],
    )
    metric: EnumProperty(
        name="Metric", default="EDGE_RATIO",
        description="Quality of triangles whose values are modelled. Means nothing to the Laplacian methods",
        items=[
            ("EDGE_RATIO", "Edge Ratio", "Longest over shortest edge"),
            ("MIN_ANGLE", "Smallest Angle", "The smallest of the three angles"),
            ("MAX_ANGLE", "Largest Angle", "The largest of the three angles"),
            ("AREA", "Area", "Area relative to the triangles around"),
            ("SHAPE", "Shape", "Area over the squares of the edges"),
        ],
    )
    keep_sizes: BoolProperty(
        name="Keep Sizes", description="Keep the ratios of neighbouring sizes: a graded mesh stays graded"
    )
    plane: EnumProperty(
        name="Plane", default="VECTOR_AREA", description="Plane in which the triangles around a vertex are modelled",
        items=[
            ("VECTOR_AREA", "Vector Area", "Moves in it cannot change the volume"),
            ("LEAST_SQUARES", "Least Squares", "Closest to the vertex and its neighbours"),
        ],
    )
    ideal: EnumProperty(
        name="Ideal", default="MODELLED", description="Shape that every triangle is asked to take",
        items=[
            ("MODELLED", "Modelled", "From the statistics of the triangles around the vertex"),
            ("EQUILATERAL", "Equilateral", "All three sides the same"),
        ],
    )
    order: EnumProperty(
        name="Order", default="COLORS", description="Order in which a sweep visits the vertices",
        items=[
            ("COLORS", "Colors", "In groups without common neighbours, on all threads"),
            ("INDEX", "Index", "By number, on one thread"),
            ("WAVE", "Wave", "As a front from the border, or from the worst triangle, on one thread"),
            ("TAIL", "Tail", "Around the worst triangles first, on one thread"),
        ],
    )
    threads: IntProperty(
        name="Threads", default=0, min=0, max=1024,
        description="Threads at most; 0 stands for as many as the machine has. The result is the same for any number",
    )
    interval_width: FloatProperty(
        name="Interval Width", default=0.5, min=0.001, max=1000,
        description="Width of the intervals in which edge ratios are sampled",
    )
    sample_limit: FloatProperty(
        name="Sample Limit", default=3, min=1, max=1e6, description="Edge ratios above this are sampled as this"
    )


class TellSettings:
    """What the user hears."""

    tell_quality: BoolProperty(
        name="Report Quality", default=True,
        description="Show the quality before and after in the status bar. Measuring takes longer than smoothing: "
        "switch it off to adjust options of large meshes",
    )


class TailSettings:
    """Which triangles are cured one by one, and how."""

    tail_edge_ratio: FloatProperty(
        name="Edge Ratio Above", default=3, min=1.01, soft_max=20, max=1e6,
        description="Treat triangles whose longest edge is more than this many times the shortest",
    )
    tail_min_angle: FloatProperty(
        name="Angle Below", subtype="ANGLE", default=radians(20), min=radians(0.1), max=radians(59.9),
        description="Treat triangles with a smaller angle than this",
    )
    tail_max_angle: FloatProperty(
        name="Angle Above", subtype="ANGLE", default=radians(130), min=radians(60.1), max=radians(179.9),
        description="Treat triangles with a larger angle than this",
    )
    tail_attempts: IntProperty(
        name="Attempts", default=3, min=1, max=1000, description="How often one triangle is taken up at most"
    )
    tail_operations: IntProperty(
        name="Most Operations", default=0, min=0, description="Operations on the whole mesh at most; 0 sets no bound"
    )
    flips: BoolProperty(
        name="Flip Edges First",
        description="Before the worst triangles are treated, flip every edge where the Delaunay criterion asks for it",
    )


class MirrorSettings:
    """Symmetry."""

    mirror: EnumProperty(
        name="Mirror", options={"ENUM_FLAG", "SKIP_SAVE"}, items=AXES, default=set(),
        description="Keep the mesh symmetric in the object's own axes",
    )


def draw(operator, context):
    """The redo panel of an operator with any of the settings above."""
    layout = operator.layout
    layout.use_property_split = True
    layout.use_property_decorate = False
    _draw_names(layout, operator, ["iterations", "relaxation", "quality_floor"])
    if hasattr(operator, "tail_edge_ratio"):
        _draw_names(layout, operator, TailSettings.__annotations__)
    _draw_region(layout.column(), operator, context)
    _draw_features(layout, operator)
    _draw_names(layout, operator, ["method", "metric", "keep_sizes", "plane", "ideal", "order", "threads"])
    _draw_names(layout, operator, ["interval_width", "sample_limit"])
    if hasattr(operator, "tell_quality"):
        layout.prop(operator, "tell_quality")


def _draw_names(layout, operator, names):
    column = layout.column()
    for name in names:
        column.prop(operator, name)


def _draw_region(column, operator, context):
    if context.mode == "EDIT_MESH":
        column.prop(operator, "selected_only")
    if context.object is not None:
        column.prop_search(operator, "vertex_group", context.object, "vertex_groups")
        row = column.row()
        row.active = bool(operator.vertex_group)
        row.prop(operator, "invert_vertex_group")
    if hasattr(operator, "mirror"):
        row = column.row(heading="Mirror", align=True)
        row.prop(operator, "mirror", expand=True)
    column.prop(operator, "boundary")


def _draw_features(layout, operator):
    column = layout.column(heading="Keep")
    row = column.row()
    row.prop(operator, "use_features", text="Angle")
    angle = row.row()
    angle.active = operator.use_features
    angle.prop(operator, "feature_angle", text="")
    for name in ("keep_sharp", "keep_seams", "keep_creases", "keep_materials", "keep_uv_borders"):
        column.prop(operator, name)
    row = layout.row(heading="Limit")
    row.prop(operator, "use_max_deviation", text="Deviation")
    distance = row.row()
    distance.active = operator.use_max_deviation
    distance.prop(operator, "max_deviation", text="")
