// What tetrahedra are like.
#ifndef TETRAHEDRA_HPP
#define TETRAHEDRA_HPP

/* Prints how many tetrahedra gmsh's current model has, and how good they are. */
void print_tetrahedra(const char *name);

#endif
