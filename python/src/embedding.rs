//! Embedded graphs: rotation systems with their faces and their genus.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use hssh_topology::{Dart, EmbeddedGraph, PendingEdge};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{indices, shaped};
use crate::errors::{argument, wrong_type};
use crate::watch::calmly;

/// A graph with a clockwise order of the edges around each vertex; parallel edges and loops are allowed.
///
/// The darts of a vertex, which are its ends of edges, are numbered consecutively in clockwise order, vertex by vertex. A dart that no
/// link names is *pending*: it holds its place in the order, but no edge is there yet.
///
/// Parameters
/// ----------
/// degrees : sequence of int
///     How many darts each vertex has.
/// links : array_like of int, shape (E, 2)
///     The two darts of each edge.
///
/// Examples
/// --------
/// >>> import hssh
/// >>> torus = hssh.EmbeddedGraph([4], [(0, 2), (1, 3)])
/// >>> torus.face_count, torus.genus
/// (1, 1)
/// >>> plane = hssh.EmbeddedGraph([4], [(0, 1), (2, 3)])
/// >>> plane.faces(), plane.is_planar
/// ([[0], [1, 3], [2]], True)
#[pyclass(name = "EmbeddedGraph", module = "hssh", frozen)]
pub(crate) struct PyEmbeddedGraph {
    graph: Mutex<EmbeddedGraph>,
}

/// No graph has more darts.
const MOST_DARTS: u64 = 1 << 28;

impl PyEmbeddedGraph {
    fn graph(&self) -> MutexGuard<'_, EmbeddedGraph> {
        self.graph.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn of(degrees: Vec<u32>, links: Vec<[u32; 2]>) -> PyResult<Self> {
        let darts: u64 = degrees.iter().map(|&degree| u64::from(degree)).sum();
        if darts > MOST_DARTS {
            return Err(argument(format!(
                "{darts} darts are more than the {MOST_DARTS} that a graph may have"
            )));
        }
        let links = links.into_iter().map(|[a, b]| (Dart::new(a), Dart::new(b)));
        let graph = EmbeddedGraph::from_links(degrees, links).map_err(argument)?;
        Ok(PyEmbeddedGraph { graph: Mutex::new(graph) })
    }
}

/// A pending edge of a graph.
fn pending(graph: &EmbeddedGraph, dart: u32) -> PyResult<PendingEdge> {
    existing(graph, dart)?;
    graph.pending(Dart::new(dart)).ok_or_else(|| argument(format!("dart {dart} is linked already")))
}

fn existing(graph: &EmbeddedGraph, dart: u32) -> PyResult<Dart> {
    if dart < graph.dart_count() {
        return Ok(Dart::new(dart));
    }
    Err(argument(format!(
        "dart {dart} does not exist: the vertices have {} darts together",
        graph.dart_count()
    )))
}

#[pymethods]
impl PyEmbeddedGraph {
    #[new]
    #[pyo3(signature = (degrees = Vec::new(), links = None))]
    fn new(degrees: Vec<u32>, links: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let links = links.map_or(Ok(Vec::new()), |links| indices::<2>("links", links, None))?;
        calmly(|| PyEmbeddedGraph::of(degrees, links))
    }

    /// The embedding of a simple graph from the neighbors of each vertex in clockwise order.
    ///
    /// Parameters
    /// ----------
    /// neighbors : dict
    ///     By vertex, the vertices that it is joined to, clockwise: what ``networkx.PlanarEmbedding.get_data`` gives. Vertices
    ///     are numbered in the order of the keys.
    ///
    /// Returns
    /// -------
    /// EmbeddedGraph
    #[staticmethod]
    fn from_rotations(neighbors: &Bound<'_, PyDict>) -> PyResult<Self> {
        let numbers = PyDict::new(neighbors.py());
        let mut lists: Vec<Vec<Bound<'_, PyAny>>> = Vec::new();
        for (number, (vertex, around)) in neighbors.iter().enumerate() {
            numbers.set_item(&vertex, number)?;
            let around = around.try_iter().map_err(|_| {
                wrong_type(format!("the neighbors of {vertex} must be a list, not {}", around.get_type()))
            })?;
            lists.push(around.collect::<PyResult<_>>()?);
        }
        let mut darts: BTreeMap<(usize, usize), u32> = BTreeMap::new();
        let mut next = 0;
        for (from, around) in lists.iter().enumerate() {
            for other in around {
                let to: usize = numbers
                    .get_item(other)?
                    .ok_or_else(|| argument(format!("{other} is a neighbor, but no vertex of the dict")))?
                    .extract()?;
                if from == to || darts.insert((from, to), next).is_some() {
                    return Err(argument(format!(
                        "{other} stands twice around a vertex, or is its own neighbor: such graphs are built from links"
                    )));
                }
                next += 1;
            }
        }
        let mut links = Vec::new();
        for (&(from, to), &dart) in &darts {
            let other = darts.get(&(to, from)).ok_or_else(|| {
                argument(format!(
                    "vertex number {from} has number {to} for a neighbor, but not the other way round"
                ))
            })?;
            if from < to {
                links.push([dart, *other]);
            }
        }
        calmly(|| PyEmbeddedGraph::of(lists.iter().map(|around| around.len() as u32).collect(), links))
    }

    /// Adds a vertex with so many pending darts.
    ///
    /// Returns
    /// -------
    /// list of int
    ///     Its darts, clockwise.
    fn add_vertex(&self, degree: u32) -> PyResult<Vec<u32>> {
        calmly(|| {
            let mut graph = self.graph();
            if u64::from(graph.dart_count()) + u64::from(degree) > MOST_DARTS {
                return Err(argument(format!("a graph may have {MOST_DARTS} darts")));
            }
            let vertex = graph.add_vertex(degree);
            Ok(graph.darts_of(vertex).map(Dart::number).collect())
        })
    }

    /// Makes two pending darts the two ends of an edge.
    ///
    /// In one face the edge splits it and keeps the genus; in two faces of one component it merges them and adds a handle.
    fn link(&self, dart: u32, other: u32) -> PyResult<()> {
        calmly(|| {
            let mut graph = self.graph();
            let ends = (pending(&graph, dart)?, pending(&graph, other)?);
            if dart == other {
                return Err(argument(format!(
                    "dart {dart} cannot be linked to itself: an edge has two ends"
                )));
            }
            let _ = graph.link(ends.0, ends.1);
            Ok(())
        })
    }

    /// int: How many vertices there are.
    #[getter]
    fn vertex_count(&self) -> u32 {
        self.graph().vertex_count()
    }

    /// int: How many edges there are; pending darts are none.
    #[getter]
    fn edge_count(&self) -> u32 {
        self.graph().edge_count()
    }

    /// int: How many darts there are, pending ones among them.
    #[getter]
    fn dart_count(&self) -> u32 {
        self.graph().dart_count()
    }

    /// int: How many connected components there are.
    #[getter]
    fn component_count(&self) -> u32 {
        self.graph().component_count()
    }

    /// int: How many faces there are; an isolated vertex has none.
    #[getter]
    fn face_count(&self) -> u32 {
        self.graph().face_count()
    }

    /// int: The least number of handles of a surface that the graph can be drawn on without crossings, with this order around each vertex.
    #[getter]
    fn genus(&self) -> u32 {
        self.graph().genus()
    }

    /// bool: Whether the genus is 0.
    #[getter]
    fn is_planar(&self) -> bool {
        self.graph().is_planar()
    }

    /// list of int: The darts that no edge is at.
    #[getter]
    fn pending(&self) -> Vec<u32> {
        self.graph().pending_edges().map(|edge| edge.dart().number()).collect()
    }

    /// ndarray of int64, shape (E, 2): The two darts of each edge, the lesser first.
    #[getter]
    fn links<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let graph = self.graph();
        let darts = (0..graph.dart_count()).map(Dart::new);
        let pairs = darts.filter_map(|dart| Some([dart, graph.rev(dart).filter(|&rev| dart < rev)?]));
        let flat: Vec<i64> = pairs.flatten().map(|dart| i64::from(dart.number())).collect();
        let edges = flat.len() / 2;
        shaped(py, flat, [edges, 2])
    }

    /// The vertex that a dart leaves.
    fn source(&self, dart: u32) -> PyResult<u32> {
        let graph = self.graph();
        let dart = existing(&graph, dart)?;
        Ok(graph.source(dart).number())
    }

    /// The other end of a dart's edge; None if it is pending.
    fn reverse(&self, dart: u32) -> PyResult<Option<u32>> {
        let graph = self.graph();
        let dart = existing(&graph, dart)?;
        Ok(graph.rev(dart).map(Dart::number))
    }

    /// Whether two pending darts lie in the same face: whether linking them keeps the genus.
    fn share_face(&self, dart: u32, other: u32) -> PyResult<bool> {
        let graph = self.graph();
        Ok(graph.face_of(pending(&graph, dart)?) == graph.face_of(pending(&graph, other)?))
    }

    /// The faces by their least dart, each as its cycle of darts, which keeps the face to the right.
    fn faces(&self) -> PyResult<Vec<Vec<u32>>> {
        calmly(|| {
            let faces = self.graph().faces();
            Ok(faces.iter().map(|face| face.iter().map(|dart| dart.number()).collect()).collect())
        })
    }

    fn __repr__(&self) -> String {
        let graph = self.graph();
        format!(
            "<EmbeddedGraph: {} vertices, {} edges, {} faces, genus {}>",
            graph.vertex_count(),
            graph.edge_count(),
            graph.face_count(),
            graph.genus()
        )
    }
}
