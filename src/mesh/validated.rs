pub(crate) struct Mesh;
