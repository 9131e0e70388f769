//! Stars taken out of the mesh: their rings, relative to their centres.

use std::iter::once;

use glam::DVec3;

use super::number::{Arithmetic, Number};
use super::vectors::{Vectors, set_vector, vector};
use crate::mesh::Stars;

/// Stars side by side at most.
const MOST: usize = 8;

/// Rim vertices of a star in company, at most.
const ROW: usize = 24;

/// Stars side by side, each relative to its centre, so that nothing depends on where in space it lies. Triangle i of a star
/// is (centre, rim vertex i, rim vertex i + 1). Reused from stars to stars.
pub(crate) struct LocalStars<N: Number> {
    /// Numbers of the vertices in the centres.
    numbers: N::Vertices,
    centres: [N::Row; 3],
    /// Where the centres are in the original mesh.
    origins: [N::Row; 3],
    /// Twice the vector areas of the sectors.
    areas: [[N::Row; 3]; 2],
    /// Numbers of triangles.
    valences: N::Row,
    /// Number of triangles of the largest star.
    longest: usize,
    /// Rim vertex at which the second sector begins; only a crease vertex has two, and only a star alone may be one.
    split: usize,
    /// Rims of stars in company.
    rims: [[u32; ROW]; MOST],
    /// As many as the largest star so far has had.
    spokes: Vec<Spoke<N>>,
}

/// A star alone.
pub(crate) type LocalStar = LocalStars<f64>;

/// A vertex, where it is, and where it is in the original mesh.
#[derive(Clone, Copy)]
pub(crate) struct Site {
    pub vertex: u32,
    pub place: DVec3,
    pub origin: DVec3,
}

/// Rim vertex number so-and-so of each star; behind the end of a rim its last vertex is repeated, so that the triangles there
/// have no area.
pub(crate) struct Spoke<N: Number> {
    /// Relative to the centres.
    place: [N::Row; 3],
    /// As they are in space.
    origin: [N::Row; 3],
    vertices: N::Vertices,
}

impl<N: Number> Default for Spoke<N> {
    fn default() -> Self {
        let vectors = [N::Row::default(); 3];
        Self { vertices: N::Vertices::default(), place: vectors, origin: vectors }
    }
}

impl<N: Number> Spoke<N> {
    /// Positions relative to the centres.
    #[inline(always)]
    pub fn place(&self, token: N::Token) -> Vectors<N> {
        Vectors::load(token, &self.place)
    }

    /// Positions in the original mesh, as they are in space.
    #[inline(always)]
    pub fn origin(&self, token: N::Token) -> Vectors<N> {
        Vectors::load(token, &self.origin)
    }

    #[inline(always)]
    fn set(&mut self, star: usize, site: Site) {
        self.vertices.as_mut()[star] = site.vertex;
        set_vector(&mut self.place, star, site.place);
        set_vector(&mut self.origin, star, site.origin);
    }
}

/// Tells triangle by triangle which stars have one.
pub(crate) struct Countdown<N> {
    left: N,
    zero: N,
    one: N,
}

impl<N: Arithmetic> Countdown<N> {
    /// For stars with `valences` triangles.
    #[inline(always)]
    pub fn new(token: N::Token, valences: N) -> Self {
        Self { left: valences, zero: N::splat(token, 0.0), one: N::splat(token, 1.0) }
    }

    /// Which stars have the next triangle.
    #[inline(always)]
    pub fn next(&mut self) -> N::Truth {
        let present = self.zero.below(self.left);
        self.left = self.left - self.one;
        present
    }
}

impl<N: Number> Default for LocalStars<N> {
    fn default() -> Self {
        let (row, vectors) = (N::Row::default(), [N::Row::default(); 3]);
        Self {
            numbers: N::Vertices::default(),
            centres: vectors,
            origins: vectors,
            areas: [vectors; 2],
            valences: row,
            longest: 0,
            split: usize::MAX,
            rims: [[0; ROW]; MOST],
            spokes: Vec::new(),
        }
    }
}

impl<N: Number> LocalStars<N> {
    /// Takes up the whole stars of `vertices`, each of which is in a triangle; `site` tells where a vertex is.
    #[inline(always)]
    pub fn take(&mut self, token: N::Token, stars: &Stars, site: impl Fn(u32) -> Site, vertices: &N::Vertices) {
        for star in 0..N::STARS {
            self.set_centre(star, site(vertices.as_ref()[star]));
        }
        self.take_rims(stars, vertices, |spoke, star, r| spoke.set(star, site(r)));
        self.center(token);
    }

    /// Makes what was gathered of `vertices` relative to them; `origin` tells where they were in the original mesh. Numbers of rim
    /// vertices, and where those were, mean nothing.
    #[inline(always)]
    pub fn relate(&mut self, token: N::Token, origin: impl Fn(u32) -> DVec3, vertices: &N::Vertices) {
        self.numbers = *vertices;
        for star in 0..N::STARS {
            set_vector(&mut self.origins, star, origin(vertices.as_ref()[star]));
        }
        self.center(token);
    }

    /// Just looks up where the vertices of stars are: nothing is relative to the centres yet.
    #[inline(always)]
    pub fn gather(&mut self, stars: &Stars, place: impl Fn(u32) -> DVec3, vertices: &N::Vertices) {
        for star in 0..N::STARS {
            set_vector(&mut self.centres, star, place(vertices.as_ref()[star]));
        }
        self.take_rims(stars, vertices, |spoke, star, r| set_vector(&mut spoke.place, star, place(r)));
    }

    /// Takes up the rims of discs; `set` writes a rim vertex of a star into a spoke.
    #[inline(always)]
    fn take_rims(&mut self, stars: &Stars, vertices: &N::Vertices, set: impl Fn(&mut Spoke<N>, usize, u32)) {
        self.split = usize::MAX;
        if N::STARS == 1 {
            let rim = stars.rim_of_disc(vertices.as_ref()[0]);
            self.valences.as_mut()[0] = f64::from(rim.len() as u32 - 1);
            self.longest = rim.len() - 1;
            self.make_room();
            self.spokes.iter_mut().zip(rim).for_each(|(spoke, &r)| set(spoke, 0, r));
            return;
        }
        self.note_rims(stars, vertices);
        self.make_room();
        // All stars of a spoke, one after the other: nothing depends on how long a rim is.
        let Self { rims, spokes, longest, .. } = self;
        for (k, spoke) in (0..ROW).zip(&mut spokes[..=*longest]) {
            for (star, rim) in rims.iter().enumerate() {
                set(spoke, star, rim[k]);
            }
        }
    }

    /// Copies the rims of stars in company, so that what is behind them can be looked up without waiting for one after the
    /// other; behind the end of a rim its last vertex is repeated.
    #[inline(always)]
    fn note_rims(&mut self, stars: &Stars, vertices: &N::Vertices) {
        let mut ends = [0; MOST];
        for (star, (rim, end)) in self.rims.iter_mut().zip(&mut ends).enumerate().take(N::STARS) {
            *end = stars.copy_rim_of_disc(vertices.as_ref()[star], rim) as i32 - 1;
        }
        for (valence, end) in self.valences.as_mut().iter_mut().zip(ends) {
            *valence = f64::from(end);
        }
        let (shortest, longest) = ends.iter().fold((i32::MAX, 0), |(s, l), &end| (s.min(end), l.max(end)));
        self.longest = longest as usize;
        if shortest == longest {
            return;
        }
        for (rim, end) in self.rims.iter_mut().zip(ends) {
            for k in end as usize..self.longest.min(ROW - 1) {
                rim[k + 1] = rim[k];
            }
        }
    }

    #[inline(always)]
    fn make_room(&mut self) {
        if self.spokes.len() <= self.longest {
            self.spokes.resize_with(self.longest + 1, Spoke::default);
        }
    }

    #[inline(always)]
    fn set_centre(&mut self, star: usize, site: Site) {
        self.numbers.as_mut()[star] = site.vertex;
        set_vector(&mut self.centres, star, site.place);
        set_vector(&mut self.origins, star, site.origin);
    }

    /// Makes all places relative to the centres, and sums up the vector areas.
    #[inline(always)]
    fn center(&mut self, token: N::Token) {
        let (centres, split) = (self.centres(token), self.split);
        let mut areas = [Vectors::zero(token); 2];
        let (first, others) = self.spokes[..=self.longest].split_at_mut(1);
        let mut a = first[0].place(token).minus(centres);
        a.store(&mut first[0].place);
        for (i, spoke) in others.iter_mut().enumerate() {
            let b = spoke.place(token).minus(centres);
            b.store(&mut spoke.place);
            let area = &mut areas[sector::<N>(split, i)];
            *area = area.plus(a.cross(b));
            a = b;
        }
        areas[0].store(&mut self.areas[0]);
        if N::STARS == 1 {
            areas[1].store(&mut self.areas[1]);
        }
    }

    /// Number of triangles of the largest star.
    #[inline(always)]
    pub fn longest(&self) -> usize {
        self.longest
    }

    /// Numbers of triangles.
    #[inline(always)]
    pub fn valences(&self, token: N::Token) -> N {
        N::load(token, &self.valences)
    }

    /// Tells triangle by triangle which stars have one.
    #[inline(always)]
    pub fn countdown(&self, token: N::Token) -> Countdown<N> {
        Countdown::new(token, self.valences(token))
    }

    /// Number of triangles of one star.
    pub fn valence_of(&self, star: usize) -> usize {
        self.valences.as_ref()[star] as usize
    }

    /// Rim vertex at which the second sector begins, or at which the rim ends.
    #[inline(always)]
    pub fn split(&self) -> usize {
        self.split.min(self.longest)
    }

    /// The sector of triangle number `i`.
    #[inline(always)]
    pub fn sector(&self, i: usize) -> usize {
        sector::<N>(self.split, i)
    }

    /// Whether a crease divides the star into two sectors.
    #[inline(always)]
    pub fn is_crease(&self) -> bool {
        N::STARS == 1 && self.split < self.longest
    }

    /// Positions of the centres.
    #[inline(always)]
    pub fn centres(&self, token: N::Token) -> Vectors<N> {
        Vectors::load(token, &self.centres)
    }

    /// Positions of the centres in the original mesh.
    #[inline(always)]
    pub fn origins(&self, token: N::Token) -> Vectors<N> {
        Vectors::load(token, &self.origins)
    }

    /// How far the centres are from where they were in the original mesh.
    #[inline(always)]
    pub fn drift(&self, token: N::Token) -> Vectors<N> {
        self.centres(token).minus(self.origins(token))
    }

    /// The rim vertices, one more than there are triangles.
    #[inline(always)]
    pub fn spokes(&self) -> &[Spoke<N>] {
        &self.spokes[..=self.longest]
    }

    /// The numbers of the rim vertices number `i`.
    pub fn vertices(&self, i: usize) -> &[u32] {
        self.spokes[i].vertices.as_ref()
    }

    /// Twice the vector areas of the two sectors; the second ones are zero where there is no crease.
    #[inline(always)]
    pub fn areas(&self, token: N::Token) -> [Vectors<N>; 2] {
        let first = Vectors::load(token, &self.areas[0]);
        [first, if N::STARS == 1 { Vectors::load(token, &self.areas[1]) } else { Vectors::zero(token) }]
    }

    /// Copies one star out.
    pub fn copy_into(&self, star: usize, alone: &mut LocalStar) {
        alone.valences = [self.valences.as_ref()[star]];
        (alone.longest, alone.split) = (self.valence_of(star), self.split);
        alone.make_room();
        for (own, areas) in alone.areas.iter_mut().zip(&self.areas) {
            set_vector(own, 0, vector(areas, star));
        }
        let site = |vertex, place, origin| Site { vertex, place: vector(place, star), origin: vector(origin, star) };
        alone.set_centre(0, site(self.numbers.as_ref()[star], &self.centres, &self.origins));
        for (own, Spoke { vertices, place, origin }) in alone.spokes[..=alone.longest].iter_mut().zip(&self.spokes) {
            own.set(0, site(vertices.as_ref()[star], place, origin));
        }
    }
}

impl LocalStar {
    /// Takes up the closed star of a crease vertex: two sectors, between the ring vertices number `first` and `second`.
    pub fn take_crease(&mut self, stars: &Stars, site: impl Fn(u32) -> Site, v: u32, [first, second]: [usize; 2]) {
        let ring = stars.ring(v);
        let rim = ring[first..].iter().chain(&ring[..=first]).map(|&r| site(r));
        self.take_alone(site(v), ring.len(), rim, second - first);
    }

    /// Takes up a closed star from its ring, whose first vertex is not repeated. The second sector starts at the ring vertex
    /// number `split`; `None`: there is none.
    pub fn take_ring(&mut self, centre: Site, ring: &[Site], split: Option<usize>) {
        let rim = ring.iter().chain(once(&ring[0])).copied();
        self.take_alone(centre, ring.len(), rim, split.unwrap_or(usize::MAX));
    }

    fn take_alone(&mut self, centre: Site, valence: usize, rim: impl Iterator<Item = Site>, split: usize) {
        self.set_centre(0, centre);
        self.valences = [valence as f64];
        (self.longest, self.split) = (valence, split);
        self.make_room();
        for (spoke, site) in self.spokes.iter_mut().zip(rim) {
            spoke.set(0, site);
        }
        self.center(());
    }

    /// Number of the vertex in the centre.
    pub fn number(&self) -> u32 {
        self.numbers[0]
    }

    /// The numbers of rim vertices `i` and `i + 1`.
    pub fn rim_edge(&self, i: usize) -> [u32; 2] {
        [self.spokes[i].vertices[0], self.spokes[i + 1].vertices[0]]
    }

    /// Position of the centre.
    pub fn centre(&self) -> DVec3 {
        vector(&self.centres, 0)
    }

    /// Number of triangles.
    pub fn valence(&self) -> usize {
        self.longest
    }

    /// Rim vertex number `i` relative to the centre.
    pub fn point(&self, i: usize) -> DVec3 {
        vector(&self.spokes[i].place, 0)
    }

    /// The rim relative to the centre.
    pub fn rim(&self) -> impl Iterator<Item = DVec3> + Clone {
        (0..=self.valence()).map(|i| self.point(i))
    }

    /// Twice the vector area of the whole star.
    pub fn double_area(&self) -> DVec3 {
        double_vector_area(self.rim())
    }

    /// The sectors: stretches of the rim with the triangles between features.
    pub fn sectors(&self) -> impl Iterator<Item = impl Iterator<Item = DVec3> + Clone> {
        let second = self.is_crease().then_some(self.split()..=self.valence());
        once(0..=self.split()).chain(second).map(|sector| sector.map(|i| self.point(i)))
    }
}

/// The sector of triangle number `i`, if the second one begins at rim vertex `split`. In company it is known beforehand, and
/// nothing has to be chosen.
#[inline(always)]
fn sector<N: Number>(split: usize, i: usize) -> usize {
    usize::from(N::STARS == 1 && i >= split)
}

/// Twice the vector area of a fan about the origin: Σ A × B. For a closed star it is the vector area of the ring and does
/// not depend on where the centre is; moving the centre by d changes the enclosed volume by a sixth of its product with d.
pub(crate) fn double_vector_area(rim: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    rim.clone().zip(rim.skip(1)).fold(DVec3::ZERO, |sum, (a, b)| sum + a.cross(b))
}
