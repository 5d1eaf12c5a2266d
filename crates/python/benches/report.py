"""The table and the figure of `peers.py`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

WAYS = {"prepared": "prepared", "grid": "on a grid", "array": "from an array"}


def line(result: dict[str, Any]) -> str:
    """Return what is shown while measuring."""
    found = {way: result[way] for way in WAYS if way in result}
    ratios = ", ".join(f"{way} {r['times_as_fast']:.3g} (least {r['least']:.3g})" for way, r in found.items())
    theirs = result["theirs"]["mean"]
    return f"{result['peer']}: {theirs:.4g} µs; {ratios}; lengths {result['difference']:.1e}"


def number(value: float) -> str:
    """Return a number with two or three digits."""
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value >= 10 else f"{value:.2g}"


def gathered(record: dict[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """Return the results of each library, one for each map."""
    results: dict[str, list[dict[str, Any]]] = {}
    for entry in record["maps"].values():
        for result in entry["paths"]:
            results.setdefault(result["peer"], []).append(result)
    return results


def mean(values: list[float]) -> float:
    """Return the geometric mean."""
    return float(np.exp(np.mean(np.log(values))))


def ratio_table(record: dict[str, Any]) -> list[str]:
    """Return how many times as fast Mediant is, a row for each library."""
    rows = [
        f"| library | rules | {' | '.join(WAYS.values())} | lengths differ by |",
        "|---|---|--:|--:|--:|--:|",
    ]
    for peer, results in gathered(record).items():
        cells = [peer, results[0]["rule"]]
        for way in WAYS:
            if way not in results[0]:
                cells.append("–")
                continue
            ratios = [result[way]["times_as_fast"] for result in results]
            least = min(result[way]["least"] for result in results)
            cells.append(f"{number(mean(ratios))} ({number(min(ratios))}, {number(least)})")
        cells.append(f"{max(result['difference'] for result in results):.0e}")
        rows.append("| " + " | ".join(cells) + " |")
    return rows


def time_tables(record: dict[str, Any]) -> list[str]:
    """Return the mean and median time of a query, a table for each map."""
    rows = []
    for name, entry in record["maps"].items():
        height, width = entry["shape"]
        rows += [
            "",
            f"**{name.split('/')[1]}** ({name.split('/')[0]}, {height} × {width} cells)",
            "",
            f"| library | queries | theirs | {' | '.join(WAYS.values())} |",
            "|---|--:|--:|--:|--:|--:|",
        ]
        for result in entry["paths"]:
            cells = [result["peer"], str(result["queries"])]
            for way in ("theirs", *WAYS):
                one = result.get(way)
                cells.append(f"{number(one['mean'])} ({number(one['median'])})" if one else "–")
            rows.append("| " + " | ".join(cells) + " |")
    return rows


def field_table(record: dict[str, Any]) -> list[str]:
    """Return the times of distance fields."""
    rows = [
        "| map | library | theirs, ms | Mediant, ms | from an array, ms | times as fast | from an array "
        "| greatest difference |",
        "|---|---|--:|--:|--:|--:|--:|--:|",
    ]
    for name, entry in record["maps"].items():
        for field in entry["fields"]:
            cells = [
                name.split("/")[1],
                field["peer"],
                *(number(field[key]) for key in ("theirs", "ours", "array")),
            ]
            cells += [number(field["theirs"] / field[way]) for way in ("ours", "array")]
            rows.append("| " + " | ".join([*cells, f"{field['difference']:.0e}"]) + " |")
    return rows


def table(record: dict[str, Any]) -> str:
    """Return the whole page of tables."""
    versions = ", ".join(f"{name} {number}" for name, number in record["versions"].items())
    rows = [
        f"{record['machine']}; Python {record['python']}; {versions}.",
        "",
        "How many times as fast as each library Mediant is: the geometric mean over the maps of the ratio of "
        "the mean times (the least of a map, the least of a query).",
        "",
        *ratio_table(record),
        "",
        "Microseconds a query, the mean and in brackets the median:",
        *time_tables(record),
    ]
    if any(entry["fields"] for entry in record["maps"].values()):
        rows += ["", "Distances from one source to all vertices:", "", *field_table(record)]
    return "\n".join(rows) + "\n"


def figure(record: dict[str, Any], out: Path) -> None:
    """Draw the mean times of each library's queries, a dot for each map, on a logarithmic axis."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "peers", "svg.fonttype": "none"})
    from matplotlib import pyplot

    results = gathered(record)
    drawing, axes = pyplot.subplots(figsize=(8, 0.55 * len(results) + 1.2), layout="constrained")
    styles = {"theirs": ("#c0392b", "the library")} | {
        way: (color, f"Mediant, {name}")
        for (way, name), color in zip(WAYS.items(), ("#1b7837", "#5aae61", "#8da0cb"))
    }
    for row, found in enumerate(results.values()):
        for place, (way, (color, label)) in enumerate(styles.items()):
            times = [result[way]["mean"] for result in found if way in result]
            height = row + 0.18 * (place - 1.5)
            if not times:
                continue
            axes.plot([min(times), max(times)], [height, height], color=color, linewidth=1)
            axes.plot(
                times, [height] * len(times), ".", color=color, markersize=5, label="" if row else label
            )
            axes.plot([mean(times)], [height], "|", color=color, markersize=10, markeredgewidth=2)
    axes.set(xscale="log", xlabel="microseconds a query: the mean of each map, and their geometric mean")
    names = [f"{peer}\n{found[0]['rule']}" for peer, found in results.items()]
    axes.set_yticks(range(len(results)), names, fontsize=8)
    axes.invert_yaxis()
    axes.grid(axis="x", alpha=0.3)
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.4, 1.12), ncols=4, frameon=False)
    drawing.savefig(out / "peers.svg", metadata={"Date": None})
    drawing.savefig(out / "peers.png", dpi=110)
