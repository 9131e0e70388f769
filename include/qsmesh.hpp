/*
 * qsmesh for C++17 and newer: the calls of qsmesh.h on containers, with exceptions and std::function.
 *
 * Everything stands in this header and calls the C functions; nothing is allocated or copied but what is said here.
 * Buffers are taken where they are: any contiguous container or view with data() and size() (std::vector, std::array,
 * std::span, Eigen's row-major matrices), a pair of pointers or, since C++20, of contiguous iterators.
 *
 * Threads: as for qsmesh.h. No object of this header is shared between calls unless you share it.
 */
#ifndef QSMESH_HPP
#define QSMESH_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#if __cplusplus >= 202002L
#include <memory>
#endif

#include "qsmesh.h"

namespace qsmesh {

/* A call that failed. what() is the library's message; no buffer has changed. */
class error : public std::runtime_error {
public:
    error(qsm_status status, const std::string &message, std::uint64_t offender, const char *offender_name)
        : std::runtime_error(message), status_(status), offender_(offender), offender_name_(offender_name)
    {
    }
    /* QSM_NULL_POINTER to QSM_PANIC. */
    qsm_status status() const noexcept { return status_; }
    /* Number of the vertex, triangle or marked edge at fault, from 0; QSM_NO_OFFENDER where no element is. */
    std::uint64_t offender() const noexcept { return offender_; }
    /* Name of the argument, option or map at fault, as in qsmesh.h; nullptr where none is. */
    const char *offender_name() const noexcept { return offender_name_; }

private:
    qsm_status status_;
    std::uint64_t offender_;
    const char *offender_name_;
};

/* What a progress function answers. */
enum class flow { proceed, cancel };

/* Called with the share that is done, 0 to 1. What it throws cancels the call and comes out of it. */
using progress_function = std::function<flow(double)>;

struct report : qsm_report {
    report() noexcept { qsm_report_init(this); }
};

struct measurement : qsm_measurement {
    measurement() noexcept { qsm_measurement_init(this); }
};

namespace detail {

/* What a contiguous container holds, whether its elements are const or not. */
template <typename C> using element = std::remove_pointer_t<decltype(std::data(std::declval<C &>()))>;

template <typename To, typename From>
using with_const_of = std::conditional_t<std::is_const_v<From>, const To, To>;

/* The coordinate behind a point: double[3], std::array<float, 3>, or the number itself. */
template <typename P, typename = void> struct scalar_of {
    using type = void;
};
template <> struct scalar_of<float> {
    using type = float;
};
template <> struct scalar_of<double> {
    using type = double;
};
template <typename T> struct scalar_of<T[3]> : scalar_of<T> {
};
template <typename T> struct scalar_of<std::array<T, 3>> : scalar_of<T> {
};

template <typename View>
inline constexpr bool is_writable = !std::is_const_v<std::remove_pointer_t<decltype(std::declval<View &>().data())>>;

/* C functions by precision. */
template <typename T> struct calls;
template <> struct calls<float> {
    static constexpr auto smooth = &qsm_smooth_f32;
    static constexpr auto collapse_tails = &qsm_collapse_tails_f32;
    static constexpr auto improve = &qsm_improve_f32;
    static constexpr auto measure = &qsm_measure_f32;
    static constexpr auto histogram = &qsm_histogram_f32;
    static constexpr auto triangle_quality = &qsm_triangle_quality_f32;
};
template <> struct calls<double> {
    static constexpr auto smooth = &qsm_smooth_f64;
    static constexpr auto collapse_tails = &qsm_collapse_tails_f64;
    static constexpr auto improve = &qsm_improve_f64;
    static constexpr auto measure = &qsm_measure_f64;
    static constexpr auto histogram = &qsm_histogram_f64;
    static constexpr auto triangle_quality = &qsm_triangle_quality_f64;
};

[[noreturn]] inline void wrong_size(const char *name, const std::string &message)
{
    throw error(QSM_BAD_OPTION, std::string(name) + " " + message, QSM_NO_OFFENDER, name);
}

/* Whether a matrix has its points (or triangles) one behind the other; containers that are no matrices always do. */
template <typename C, typename = void> struct is_in_order : std::true_type {
};
template <typename C>
struct is_in_order<C, std::void_t<decltype(C::IsRowMajor), decltype(C::ColsAtCompileTime)>>
    : std::bool_constant<(C::IsRowMajor && C::ColsAtCompileTime == 3) ||
                         (!C::IsRowMajor && C::RowsAtCompileTime == 3) || C::IsVectorAtCompileTime> {
};
template <typename C> inline constexpr bool in_order = is_in_order<std::remove_cv_t<std::remove_reference_t<C>>>::value;

} // namespace detail

/*
 * Where vertices are: T is float, double, or const of these for calls that only read. Made from containers of numbers
 * (three a vertex), of std::array<T, 3> or T[3], or of structs with a member that is a point.
 */
template <typename T> class points {
public:
    using scalar = std::remove_const_t<T>;

    points(T *first, std::size_t count, std::size_t stride_bytes = 3 * sizeof(T)) noexcept
        : first_(first), count_(count), stride_(stride_bytes)
    {
    }
    T *data() const noexcept { return first_; }
    std::size_t size() const noexcept { return count_; }
    std::size_t stride_bytes() const noexcept { return stride_; }

private:
    T *first_;
    std::size_t count_;
    std::size_t stride_;
};

/* Where triangles are: three vertex numbers each. N is std::uint32_t, or const of it. */
template <typename N> class corners {
public:
    corners(N *first, std::size_t count) noexcept : first_(first), count_(count) {}
    N *data() const noexcept { return first_; }
    /* Numbers, three times as many as triangles. */
    std::size_t size() const noexcept { return count_; }

private:
    N *first_;
    std::size_t count_;
};

/* Points in a contiguous container of numbers or of points. Throws where numbers are no multiple of 3. */
template <typename C> auto points_of(C &&container)
{
    using held = detail::element<C>;
    using scalar = typename detail::scalar_of<std::remove_cv_t<held>>::type;
    static_assert(!std::is_void_v<scalar>, "positions are float or double, or arrays of three of these; for structs, "
                                           "name the member that is the position: points_of(vertices, &vertex::at)");
    static_assert(detail::in_order<C>, "a matrix has points by rows of three, or by columns of three");
    using number = detail::with_const_of<scalar, held>;
    const auto size = static_cast<std::size_t>(std::size(container));
    auto *first = reinterpret_cast<number *>(std::data(container));
    if constexpr (std::is_same_v<std::remove_cv_t<held>, scalar>) {
        if (size % 3 != 0) {
            detail::wrong_size("positions", "are no multiple of 3 numbers");
        }
        return points<number>(first, size / 3);
    } else {
        return points<number>(first, size);
    }
}

/* Points in a contiguous container of structs: the member at `position`. Nothing else of a struct is touched. */
template <typename C, typename S, typename P> auto points_of(C &&container, P S::*position)
{
    using scalar = typename detail::scalar_of<std::remove_cv_t<P>>::type;
    static_assert(!std::is_void_v<scalar>, "the position is an array of three float or double");
    using held = detail::element<C>;
    static_assert(std::is_same_v<std::remove_cv_t<held>, S>, "the container holds what the position is a member of");
    using number = detail::with_const_of<scalar, held>;
    const auto size = static_cast<std::size_t>(std::size(container));
    number *first = nullptr;
    if (size != 0) {
        first = reinterpret_cast<number *>(&(std::data(container)->*position));
    }
    return points<number>(first, size, sizeof(S));
}

template <typename T> points<T> points_of(points<T> view) noexcept
{
    return view;
}

/* Triangles in a contiguous container of numbers, or of anything that is three numbers of 32 bits. */
template <typename C> auto corners_of(C &&container)
{
    using held = detail::element<C>;
    using number = detail::with_const_of<std::uint32_t, held>;
    constexpr bool is_number = std::is_same_v<std::remove_cv_t<held>, std::uint32_t>;
    constexpr bool is_triangle = std::is_same_v<std::remove_cv_t<held>, std::array<std::uint32_t, 3>> ||
                                 std::is_same_v<std::remove_cv_t<held>, std::uint32_t[3]>;
    static_assert(detail::in_order<C>, "a matrix has triangles by rows of three, or by columns of three");
    static_assert(is_number || is_triangle, "triangles are std::uint32_t, three each, or arrays of three of these");
    const auto size = static_cast<std::size_t>(std::size(container));
    return corners<number>(reinterpret_cast<number *>(std::data(container)), is_number ? size : 3 * size);
}

template <typename N> corners<N> corners_of(corners<N> view) noexcept
{
    return view;
}

/* The same for what lies between two pointers or, since C++20, two contiguous iterators. */
template <typename I> auto points_between(I first, I last)
{
#if __cplusplus >= 202002L
    static_assert(std::contiguous_iterator<I>, "vertices stand behind one another in memory");
    auto *start = std::to_address(first);
#else
    static_assert(std::is_pointer_v<I>, "before C++20 only pointers are known to be contiguous");
    auto *start = first;
#endif
    using held = std::remove_pointer_t<decltype(start)>;
    struct view {
        held *first;
        std::size_t count;
        held *data() const noexcept { return first; }
        std::size_t size() const noexcept { return count; }
    };
    return points_of(view{start, static_cast<std::size_t>(last - first)});
}

/*
 * Settings, with the fields of qsm_options and containers for its arrays. What is handed to lock, features and mask
 * must outlive the calls; a copy of the settings refers to the same memory.
 */
struct options : qsm_options {
    options() noexcept { qsm_options_init(this); }

    /* Called as the work goes on; empty: nobody is asked. Takes the place of `progress` and `user`. */
    progress_function on_progress;

    /* One byte a vertex; a vertex whose byte is not 0 keeps its bits. */
    template <typename C> options &lock(const C &bytes)
    {
        vertex_lock = byte_array(bytes, lock_count_);
        return *this;
    }
    /* Edges to be kept: two vertex numbers each, in a container of numbers or of pairs in arrays. */
    template <typename C> options &features(const C &edges)
    {
        using held = std::remove_cv_t<detail::element<const C>>;
        constexpr bool is_number = std::is_same_v<held, std::uint32_t>;
        static_assert(is_number || std::is_same_v<held, std::array<std::uint32_t, 2>> ||
                          std::is_same_v<held, std::uint32_t[2]>,
                      "edges are std::uint32_t, two each, or arrays of two of these");
        const auto size = static_cast<std::size_t>(std::size(edges));
        if (is_number && size % 2 != 0) {
            detail::wrong_size("feature_edges", "are no multiple of 2 numbers");
        }
        feature_edges = reinterpret_cast<const std::uint32_t *>(std::data(edges));
        feature_edge_count = is_number ? size / 2 : size;
        return *this;
    }
    /* One byte a triangle; a triangle whose byte is 0 is never taken up as one of the tail. */
    template <typename C> options &mask(const C &bytes)
    {
        triangle_mask = byte_array(bytes, mask_count_);
        return *this;
    }

    /* Name of the array that came from a container of another length than the mesh asks for; nullptr if none did. */
    const char *misfit(std::size_t vertex_count, std::size_t index_count) const noexcept
    {
        if (vertex_lock != nullptr && lock_count_ != unknown && lock_count_ != vertex_count) {
            return "vertex_lock";
        }
        if (triangle_mask != nullptr && mask_count_ != unknown && mask_count_ != index_count / 3) {
            return "triangle_mask";
        }
        return nullptr;
    }

private:
    static constexpr std::size_t unknown = static_cast<std::size_t>(-1);
    /* A pointer set by hand says nothing of its length. */
    std::size_t lock_count_ = unknown;
    std::size_t mask_count_ = unknown;

    template <typename C> static const std::uint8_t *byte_array(const C &bytes, std::size_t &count)
    {
        static_assert(sizeof(detail::element<const C>) == 1, "one byte each");
        count = static_cast<std::size_t>(std::size(bytes));
        return reinterpret_cast<const std::uint8_t *>(std::data(bytes));
    }
};

/* Where everything came from after improve and collapse_tails, as in qsm_maps, in vectors that the calls size. */
struct maps {
    std::vector<std::uint32_t> vertex_source;
    std::vector<std::uint32_t> triangle_source;
    std::vector<std::uint32_t> corner_source;
    std::vector<qsm_leftover> leftovers;
};

/* How much of the buffers is left after improve and collapse_tails on views. */
struct counts {
    std::size_t vertices;
    /* Numbers, three times as many as triangles. */
    std::size_t indices;
};

namespace detail {

/* Brings a std::function through the C callback, and what it throws back out. */
class bridge {
public:
    explicit bridge(const options &from) : given_(&from)
    {
        if (from.on_progress) {
            with_callback_ = from;
            with_callback_.progress = &ask;
            with_callback_.user = this;
            function_ = &from.on_progress;
            given_ = &with_callback_;
        }
    }
    bridge(const bridge &) = delete;
    bridge &operator=(const bridge &) = delete;

    const qsm_options *get() const noexcept { return given_; }
    void rethrow() const
    {
        if (thrown_) {
            std::rethrow_exception(thrown_);
        }
    }

private:
    static qsm_flow ask(double done, void *user) noexcept
    {
        auto *self = static_cast<bridge *>(user);
        try {
            return (*self->function_)(done) == flow::proceed ? QSM_CONTINUE : QSM_CANCEL;
        } catch (...) {
            self->thrown_ = std::current_exception();
            return QSM_CANCEL;
        }
    }

    const qsm_options *given_;
    const progress_function *function_ = nullptr;
    qsm_options with_callback_;
    std::exception_ptr thrown_;
};

[[noreturn]] inline void fail(qsm_status status, const qsm_report &said)
{
    const bool told = said.status == status && said.message[0] != '\0';
    throw error(status, told ? said.message : qsm_status_string(status), told ? said.offender : QSM_NO_OFFENDER,
                told ? said.offender_name : nullptr);
}

/* Runs a call and gives its status; throws what on_progress threw. */
template <typename Call> qsm_status attempt(const options &settings, qsm_report *out, const Call &call)
{
    const bridge passed(settings);
    const qsm_status status = call(passed.get(), out);
    passed.rethrow();
    return status;
}

/*
 * Runs a call and throws what it failed with. A report makes the library measure, so a caller who wants none is not
 * made to pay for one: only a call that has failed is made again to be told why. It fails in the same way, as nothing
 * has changed, before any work is done.
 */
template <typename Call> void run(const options &settings, qsm_report *out, const Call &call)
{
    const qsm_status status = attempt(settings, out, call);
    if (status == QSM_OK) {
        return;
    }
    if (out != nullptr || status == QSM_CANCELLED || status == QSM_OUT_OF_MEMORY || status == QSM_PANIC) {
        fail(status, out != nullptr ? *out : report());
    }
    report said;
    call(static_cast<const qsm_options *>(&settings), &said);
    fail(status, said);
}

inline void check(const options &settings, std::size_t vertex_count, std::size_t index_count)
{
    if (const char *name = settings.misfit(vertex_count, index_count)) {
        wrong_size(name, "has another length than the mesh asks for");
    }
}

/* qsm_smooth_* on views, with all that it needs but options and report. */
template <typename P, typename I> auto smoothing(const P &at, const I &numbers)
{
    return [at, numbers](const qsm_options *passed, qsm_report *told) {
        return calls<typename P::scalar>::smooth(at.data(), at.size(), at.stride_bytes(), numbers.data(),
                                                 numbers.size(), passed, told);
    };
}

/* Vectors with room for all that may come out, and the struct that points into them. */
inline qsm_maps with_room(maps &m, std::size_t vertices, std::size_t indices)
{
    m.vertex_source.resize(vertices);
    m.triangle_source.resize(indices / 3);
    m.corner_source.resize(indices);
    m.leftovers.resize(indices / 3);
    qsm_maps raw;
    qsm_maps_init(&raw);
    raw.vertex_source = m.vertex_source.data();
    raw.triangle_source = m.triangle_source.data();
    raw.corner_source = m.corner_source.data();
    raw.leftovers = m.leftovers.data();
    raw.leftover_capacity = m.leftovers.size();
    return raw;
}

inline void cut(maps &m, const qsm_maps &raw, counts left)
{
    m.vertex_source.resize(left.vertices);
    m.triangle_source.resize(left.indices / 3);
    m.corner_source.resize(left.indices);
    m.leftovers.resize(raw.leftover_count);
}

/* A call that may shrink the mesh, with all that it needs but options and report. Counts go in and come out. */
template <typename F, typename P, typename I>
auto shrinking(F function, const P &at, const I &triangles, counts &left, qsm_maps *raw)
{
    left = counts{at.size(), triangles.size()};
    return [=, &left](const qsm_options *passed, qsm_report *told) {
        return function(at.data(), &left.vertices, at.stride_bytes(), triangles.data(), &left.indices, passed, raw,
                        told);
    };
}

template <typename F, typename P, typename I>
counts shrink(F function, const P &at, const I &triangles, const options &settings, qsm_maps *raw, qsm_report *out)
{
    check(settings, at.size(), triangles.size());
    counts left{};
    run(settings, out, shrinking(function, at, triangles, left, raw));
    return left;
}

template <typename F, typename P, typename I>
qsm_status try_shrink(F function, const P &at, const I &triangles, counts &left, const options &settings,
                      qsm_maps *raw, qsm_report *out)
{
    const auto call = shrinking(function, at, triangles, left, raw);
    return settings.misfit(at.size(), triangles.size()) ? QSM_BAD_OPTION : attempt(settings, out, call);
}

template <typename F, typename P, typename I>
counts shrink(F function, const P &at, const I &triangles, const options &settings, maps &m, qsm_report *out)
{
    qsm_maps raw = with_room(m, at.size(), triangles.size());
    const counts left = shrink(function, at, triangles, settings, &raw, out);
    cut(m, raw, left);
    return left;
}

/* A container of numbers has three for each of its elements, one of points or triangles one. */
template <typename C, typename Number> void cut_container(C &container, std::size_t elements)
{
    constexpr bool numbers = std::is_same_v<std::remove_cv_t<element<C>>, Number>;
    container.resize(numbers ? 3 * elements : elements);
}

template <typename P, typename I> void cut_containers(P &positions, I &triangles, counts left)
{
    using scalar = typename decltype(points_of(positions))::scalar;
    cut_container<P, scalar>(positions, left.vertices);
    cut_container<I, std::uint32_t>(triangles, left.indices / 3);
}

} // namespace detail

/*
 * qsm_smooth_*: positions are moved in place. Throws qsmesh::error, or what on_progress threw, and then nothing has
 * changed. With a report the library measures too.
 */
template <typename P, typename I>
void smooth(P &&positions, const I &triangles, const options &settings = {}, qsm_report *out = nullptr)
{
    const auto at = points_of(positions);
    const auto numbers = corners_of(triangles);
    static_assert(detail::is_writable<decltype(at)>, "positions are moved in place, so they are not const");
    detail::check(settings, at.size(), numbers.size());
    detail::run(settings, out, detail::smoothing(at, numbers));
}

/*
 * The same with the status as its value. Throws only what on_progress threw. QSM_BAD_OPTION without a word in the
 * report stands for a lock or mask of another length than the mesh asks for.
 */
template <typename P, typename I>
[[nodiscard]] qsm_status try_smooth(P &&positions, const I &triangles, const options &settings = {},
                                    qsm_report *out = nullptr)
{
    const auto at = points_of(positions);
    const auto numbers = corners_of(triangles);
    static_assert(detail::is_writable<decltype(at)>, "positions are moved in place, so they are not const");
    return settings.misfit(at.size(), numbers.size()) ? QSM_BAD_OPTION
                                                      : detail::attempt(settings, out, detail::smoothing(at, numbers));
}

/* qsm_improve_* on buffers that keep their length; says how much of them is left. */
template <typename T>
counts improve(points<T> positions, corners<std::uint32_t> triangles, const options &settings = {},
               qsm_maps *sources = nullptr, qsm_report *out = nullptr)
{
    return detail::shrink(detail::calls<T>::improve, positions, triangles, settings, sources, out);
}

/* The same with the maps in vectors. */
template <typename T>
counts improve(points<T> positions, corners<std::uint32_t> triangles, const options &settings, maps &sources,
               qsm_report *out = nullptr)
{
    return detail::shrink(detail::calls<T>::improve, positions, triangles, settings, sources, out);
}

/* qsm_improve_* on containers that are cut to what is left. */
template <typename P, typename I, typename = decltype(std::declval<P &>().resize(0))>
void improve(P &positions, I &triangles, const options &settings = {}, qsm_report *out = nullptr)
{
    const counts left =
        improve(points_of(positions), corners_of(triangles), settings, static_cast<qsm_maps *>(nullptr), out);
    detail::cut_containers(positions, triangles, left);
}

template <typename P, typename I, typename = decltype(std::declval<P &>().resize(0))>
void improve(P &positions, I &triangles, const options &settings, maps &sources, qsm_report *out = nullptr)
{
    const counts left = improve(points_of(positions), corners_of(triangles), settings, sources, out);
    detail::cut_containers(positions, triangles, left);
}

/* The same with the status as its value, as with try_smooth; `left` is what is left, or all after a failure. */
template <typename T>
[[nodiscard]] qsm_status try_improve(points<T> positions, corners<std::uint32_t> triangles, counts &left,
                                     const options &settings = {}, qsm_maps *sources = nullptr,
                                     qsm_report *out = nullptr)
{
    return detail::try_shrink(detail::calls<T>::improve, positions, triangles, left, settings, sources, out);
}

/* qsm_collapse_tails_*, in the same five ways. */
template <typename T>
counts collapse_tails(points<T> positions, corners<std::uint32_t> triangles, const options &settings = {},
                      qsm_maps *sources = nullptr, qsm_report *out = nullptr)
{
    return detail::shrink(detail::calls<T>::collapse_tails, positions, triangles, settings, sources, out);
}

template <typename T>
counts collapse_tails(points<T> positions, corners<std::uint32_t> triangles, const options &settings, maps &sources,
                      qsm_report *out = nullptr)
{
    return detail::shrink(detail::calls<T>::collapse_tails, positions, triangles, settings, sources, out);
}

template <typename P, typename I, typename = decltype(std::declval<P &>().resize(0))>
void collapse_tails(P &positions, I &triangles, const options &settings = {}, qsm_report *out = nullptr)
{
    const counts left =
        collapse_tails(points_of(positions), corners_of(triangles), settings, static_cast<qsm_maps *>(nullptr), out);
    detail::cut_containers(positions, triangles, left);
}

template <typename P, typename I, typename = decltype(std::declval<P &>().resize(0))>
void collapse_tails(P &positions, I &triangles, const options &settings, maps &sources, qsm_report *out = nullptr)
{
    const counts left = collapse_tails(points_of(positions), corners_of(triangles), settings, sources, out);
    detail::cut_containers(positions, triangles, left);
}

template <typename T>
[[nodiscard]] qsm_status try_collapse_tails(points<T> positions, corners<std::uint32_t> triangles, counts &left,
                                            const options &settings = {}, qsm_maps *sources = nullptr,
                                            qsm_report *out = nullptr)
{
    return detail::try_shrink(detail::calls<T>::collapse_tails, positions, triangles, left, settings, sources, out);
}

/* qsm_measure_*. Throws qsmesh::error. */
template <typename P, typename I> measurement measure(const P &positions, const I &triangles)
{
    const auto at = points_of(positions);
    const auto numbers = corners_of(triangles);
    measurement measured;
    const qsm_status status = detail::calls<typename decltype(at)::scalar>::measure(
        at.data(), at.size(), at.stride_bytes(), numbers.data(), numbers.size(), &measured);
    if (status != QSM_OK) {
        detail::fail(status, report());
    }
    return measured;
}

/* qsm_histogram_*: how many triangles have a value in each of `bins` intervals from `lower` on. Throws as measure. */
template <typename P, typename I>
std::vector<std::size_t> histogram(const P &positions, const I &triangles, qsm_parameter parameter, double lower,
                                   double interval, std::size_t bins)
{
    const auto at = points_of(positions);
    const auto numbers = corners_of(triangles);
    std::vector<std::size_t> counted(bins);
    const qsm_status status = detail::calls<typename decltype(at)::scalar>::histogram(
        at.data(), at.size(), at.stride_bytes(), numbers.data(), numbers.size(), parameter, lower, interval,
        counted.data(), bins);
    if (status != QSM_OK) {
        detail::fail(status, report());
    }
    return counted;
}

/* qsm_triangle_quality_*: the value of `parameter` for each triangle. Throws as measure. */
template <typename P, typename I>
std::vector<double> triangle_quality(const P &positions, const I &triangles, qsm_parameter parameter)
{
    const auto at = points_of(positions);
    const auto numbers = corners_of(triangles);
    std::vector<double> values(numbers.size() / 3);
    const qsm_status status = detail::calls<typename decltype(at)::scalar>::triangle_quality(
        at.data(), at.size(), at.stride_bytes(), numbers.data(), numbers.size(), parameter, values.data());
    if (status != QSM_OK) {
        detail::fail(status, report());
    }
    return values;
}

} // namespace qsmesh

#endif
