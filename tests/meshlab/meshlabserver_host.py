"""Debian's MeshLab 2020.09, in single precision, with the plugin: filter scripts in, meshes and log out."""
import os
import pathlib
import subprocess
import xml.sax.saxutils

SMOOTH = 'Quasi-statistical smoothing'
IMPROVE = 'Quasi-statistical improvement'

# Type and default of every option. This MeshLab ends where a script leaves out more than one.
_SMOOTH_OPTIONS = {
    'selected': ('RichBool', False),
    'boundary': ('RichEnum', 0),
    'iterations': ('RichInt', 2),
    'relaxation': ('RichFloat', 1.2),
    'plane': ('RichEnum', 0),
    'ideal': ('RichEnum', 0),
    'method': ('RichEnum', 0),
    'metric': ('RichEnum', 0),
    'keep_sizes': ('RichBool', False),
    'features': ('RichBool', True),
    'feature_angle': ('RichFloat', 30.0),
    'max_deviation': ('RichAbsPerc', 0.0),
    'keep_seams': ('RichBool', True),
    'keep_color_borders': ('RichBool', False),
    'order': ('RichEnum', 0),
    'threads': ('RichInt', 0),
    'quality_floor': ('RichFloat', 0.5),
    'interval_width': ('RichFloat', 0.5),
    'sample_limit': ('RichFloat', 3.0),
    'face_quality': ('RichBool', False),
}
_IMPROVE_OPTIONS = {
    **_SMOOTH_OPTIONS,
    'tail_edge_ratio': ('RichFloat', 3.0),
    'tail_min_angle': ('RichFloat', 20.0),
    'tail_max_angle': ('RichFloat', 130.0),
    'flips': ('RichBool', False),
    'tail_attempts': ('RichInt', 3),
    'tail_operations': ('RichInt', 0),
    'select_leftovers': ('RichBool', False),
}
_OPTIONS = {
    SMOOTH: _SMOOTH_OPTIONS,
    IMPROVE: _IMPROVE_OPTIONS,
    'Conditional Vertex Selection': {'condSelect': ('RichString', '')},
    'Conditional Face Selection': {'condSelect': ('RichString', '')},
    'Delete Selected Vertices': {},
}

_EXTRA = {
    'RichEnum': ' enum_cardinality="5" enum_val0="" enum_val1="" enum_val2="" enum_val3="" enum_val4=""',
    'RichAbsPerc': ' min="0" max="1"',
}


def _parameter(name, kind, value):
    text = str(value).lower() if kind == 'RichBool' else str(value)
    quoted = xml.sax.saxutils.quoteattr(text)
    return f'  <Param type="{kind}" name="{name}" value={quoted} description="" tooltip=""{_EXTRA.get(kind, "")}/>\n'


def script(*filters):
    """A filter script. Each filter is a name and its options, of which those that are not given get their defaults."""
    text = '<!DOCTYPE FilterScript>\n<FilterScript>\n'
    for name, given in filters:
        unknown = set(given) - set(_OPTIONS[name])
        assert not unknown, unknown
        rows = [_parameter(option, kind, given.get(option, default))
                for option, (kind, default) in _OPTIONS[name].items()]
        text += f' <filter name="{name}">\n{"".join(rows)} </filter>\n'
    return text + '</FilterScript>\n'


def run(folder, mesh, *filters, root=None):
    """Runs filters on a mesh file. Returns exit status, log, and the path of the new file."""
    root = root or pathlib.Path(os.environ['QSMESH_MESHLAB_ROOT'])
    out = folder / 'out.ply'
    (folder / 'script.mlx').write_text(script(*filters))
    # The display's own end, which fails now and then on a busy machine, is not the host's status.
    status = folder / 'status'
    call = ['xvfb-run', '-a', 'sh', '-c', '"$@"; echo $? >"$0"', str(status), str(root / 'usr/bin/meshlabserver'),
            '-i', str(mesh), '-o', str(out), '-s', str(folder / 'script.mlx')]
    done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300,
                          env={**os.environ, 'XDG_RUNTIME_DIR': str(folder), 'HOME': str(folder)})
    return int(status.read_text()), done.stdout, out
