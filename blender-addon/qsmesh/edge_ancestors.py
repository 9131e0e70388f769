# SPDX-License-Identifier: GPL-3.0-or-later
"""New edges take after the old ones in whose place they lie: a marked line stays marked where vertices of it are gone."""


class EdgeAncestors:
    """Makes edges in a BMesh while the old ones are still there."""

    def __init__(self, edited, removed):
        """removed: vertices that will go, a set."""
        self.edited = edited
        self.removed = removed
        layers = edited.edges.layers
        # Blender 4.0 made the crease one attribute among others.
        old = getattr(layers, "crease", None)
        self.crease = old.active if old is not None else layers.float.get("crease_edge")

    def ensure_edge(self, start, end):
        """Makes the edge between two vertices unless it is there."""
        if self.edited.edges.get((start, end)) is None:
            self.edited.edges.new((start, end), *self._ancestor(start, end))

    def _ancestor(self, start, end):
        """The old edge to copy, as a list of at most one."""
        return self._along_marks(start, end) or self._beside(start, end)

    def _marked(self, edge):
        return edge.seam or not edge.smooth or (self.crease is not None and edge[self.crease] > 0)

    def _along_marks(self, start, end):
        """An edge of a marked line that leads from start over removed vertices to end."""
        reached, seen = [start], {start}
        for vertex in reached:
            for edge in filter(self._marked, vertex.link_edges):
                other = edge.other_vert(vertex)
                if other is end and vertex is not start:
                    return [edge]
                if other in self.removed and other not in seen:
                    seen.add(other)
                    reached.append(other)
        return []

    def _beside(self, start, end):
        """An unmarked edge from end to a removed neighbour of start."""
        for edge in end.link_edges:
            other = edge.other_vert(end)
            if other in self.removed and not self._marked(edge) and self.edited.edges.get((start, other)) is not None:
                return [edge]
        return []
