"""Compares the sweeps of wormdrive with OpenTURNS: distributions, copula, Sobol indices, Shapley effects, rank
correlations.

usage: openturns_oracle.py PROGRAM     (Debian: python3-openturns)
"""

import csv
import io
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import openturns as ot

# A flywheel that a motor accelerates against a fan: its final speed is smooth in all three, which act together.
SCENARIO = """[mesh]
kind = "none"
inertia_kgm2 = 1
[[motor.torque]]
kind = "constant"
torque_Nm = 1
[[load]]
kind = "fan"
torque_Nm = 1
speed_rad_per_s = 1
[run]
duration_s = 1
report_interval_s = 1
solver = "taylor"
"""
PATHS = ["motor.torque[0].torque_Nm", "load[0].torque_Nm", "mesh.inertia_kgm2"]

DISTRIBUTIONS = {
    "uniform": ({"low": 1.0, "high": 3.0}, ot.Uniform(1.0, 3.0)),
    "normal": ({"mean": 1.0, "deviation": 0.2}, ot.Normal(1.0, 0.2)),
    "truncated_normal": ({"mean": 1.0, "deviation": 0.5, "low": 0.8, "high": 2.5},
                         ot.TruncatedNormal(1.0, 0.5, 0.8, 2.5)),
    "lognormal": ({"median": 2.0, "log_deviation": 0.3}, ot.LogNormal(np.log(2.0), 0.3)),
    "log_uniform": ({"low": 0.1, "high": 5.0}, ot.LogUniform(np.log(0.1), np.log(5.0))),
    "triangular": ({"low": 0.5, "mode": 1.0, "high": 3.0}, ot.Triangular(0.5, 1.0, 3.0)),
    # mean (low + 4 mode + high)/6: shapes 1 + 4 (mode - low)/(high - low) and 1 + 4 (high - mode)/(high - low)
    "pert": ({"low": 0.5, "mode": 1.0, "high": 3.0}, ot.Beta(1.8, 4.2, 0.5, 3.0)),
    "beta": ({"alpha": 0.7, "beta": 2.5, "low": 0.5, "high": 3.0}, ot.Beta(0.7, 2.5, 0.5, 3.0)),
    "gumbel": ({"mode": 1.0, "scale": 0.2}, ot.Gumbel(0.2, 1.0)),
    "weibull": ({"shape": 1.7, "scale": 0.5, "low": 0.3}, ot.WeibullMin(0.5, 1.7, 0.3)),
}

faults = []


def check(what, holds):
    print(f"{'ok' if holds else 'FAULT':6} {what}")
    if not holds:
        faults.append(what)


def sweep(program, design, parameters, correlations=""):
    """Returns the inputs, the final speeds and the summary of a sweep; a parameter is a path and its TOML."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "s.toml").write_text(SCENARIO)
        (folder / "study.toml").write_text(f'scenario = "s.toml"\n[sweep]\nseed = 5\n{design}\n' + "".join(
            f'[[parameter]]\npath = "{path}"\n{text}' for path, text in parameters) + correlations)

        def run(*arguments):
            return subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True, text=True).stdout

        run("sweep", "study.toml", "-o", "o.h5", "-q", "--referee", "1")
        rows = list(csv.DictReader(io.StringIO(run("export", "o.h5"))))
        summary = json.loads(run("summary", "o.h5", "--metric", "final_gear_speed", "--json"))
    inputs = np.array([[float(row[path]) for path, _ in parameters] for row in rows])
    return inputs, np.array([float(row["final_gear_speed_rad_per_s"]) for row in rows]), summary


def keys(distribution):
    numbers, _ = DISTRIBUTIONS[distribution]
    return f'distribution = "{distribution}"\n' + "".join(f"{key} = {value}\n" for key, value in numbers.items())


def compare_distributions(program):
    levels = 1000
    for name, (_, reference) in DISTRIBUTIONS.items():
        inputs, _, _ = sweep(program, f'design = "grid"\nlevels = {levels}', [(PATHS[0], keys(name))])
        exact = np.array([reference.computeQuantile((k + 0.5) / levels)[0] for k in range(levels)])
        worst = np.max(np.abs(inputs[:, 0] / exact - 1.0))
        check(f"{name}: quantiles agree within {worst:.1e}", worst < 1e-9)


def compare_copula(program):
    names, rho, trials = ["lognormal", "gumbel", "beta"], {(0, 1): 0.7, (0, 2): -0.4}, 20000
    text = "".join(f'[[correlation]]\nbetween = ["{PATHS[j]}", "{PATHS[k]}"]\ncoefficient = {r}\n'
                   for (j, k), r in rho.items())
    matrix = ot.CorrelationMatrix(3)
    for place, r in rho.items():
        matrix[place] = r
    joint = ot.ComposedDistribution([DISTRIBUTIONS[name][1] for name in names], ot.NormalCopula(matrix))
    inputs, _, _ = sweep(program, f'design = "monte_carlo"\ntrials = {trials}',
                         [(path, keys(name)) for path, name in zip(PATHS, names)], text)
    # conditional probabilities of draws are uniform and independent [Rosenblatt1952]
    u = ot.Sample([joint.computeSequentialConditionalCDF(x) for x in inputs])
    for k in range(3):
        p = ot.FittingTest.Kolmogorov(u.getMarginal(k), ot.Uniform(0.0, 1.0)).getPValue()
        check(f"copula: conditional probabilities of parameter {k} are uniform, p = {p:.2f}", p > 1e-3)
    worst = np.max(np.abs(np.array(u.computeSpearmanCorrelation()) - np.eye(3)))
    check(f"copula: they are independent, rank correlation at most {worst:.3f}", worst < 4.0 / np.sqrt(trials))


def compare_indices(program):
    names = ["uniform", "triangular", "weibull"]
    parameters = [(path, keys(name)) for path, name in zip(PATHS, names)]
    # the speed is smooth in its parameters: a polynomial chaos expansion has its indices to several digits
    inputs, speeds, _ = sweep(program, 'design = "sobol"\ntrials = 4096', parameters)
    own = [DISTRIBUTIONS[name][1] for name in names]
    basis = ot.OrthogonalProductPolynomialFactory([ot.StandardDistributionPolynomialFactory(d) for d in own])
    strategy = ot.FixedStrategy(basis, ot.LinearEnumerateFunction(3).getStrataCumulatedCardinal(7))
    chaos = ot.FunctionalChaosAlgorithm(ot.Sample(inputs), ot.Sample(speeds[:, None]), ot.ComposedDistribution(own),
                                        strategy)
    chaos.run()
    left = chaos.getResult().getRelativeErrors()[0]
    check(f"the expansion leaves {left:.1e} of the variance", left < 1e-5)
    exact = ot.FunctionalChaosSobolIndices(chaos.getResult())

    def compare(what, estimate, reference):
        width = estimate["high"] - estimate["low"]  # 95 % interval
        check(f"{what}: {estimate['value']:.4f} +- {width / 2:.4f}, OpenTURNS {reference:.4f}",
              width < 0.05 and abs(estimate["value"] - reference) < 0.75 * width + 1e-3)

    _, _, summary = sweep(program, 'design = "saltelli"\nsamples = 4096\nsecond_order = true', parameters)
    found = {i["parameter"]: i["sobol"] for i in summary["influences"]}
    for k, path in enumerate(PATHS):
        compare(f"first Sobol index of {path}", found[path]["first"], exact.getSobolIndex(k))
        compare(f"total Sobol index of {path}", found[path]["total"], exact.getSobolTotalIndex(k))
    for pair in summary["sobol"]["pairs"]:
        places = [PATHS.index(path) for path in pair["between"]]
        compare(f"second-order index of parameters {places}", pair, exact.getSobolIndex(places))
    # of independent parameters: what several do together in equal parts
    _, _, summary = sweep(program, 'design = "shapley"\npermutations = 10000', parameters)
    for k, path in enumerate(PATHS):
        others = [j for j in range(3) if j != k]
        share = (exact.getSobolIndex(k) + sum(exact.getSobolIndex(sorted([j, k])) for j in others) / 2
                 + exact.getSobolIndex([0, 1, 2]) / 3)
        compare(f"Shapley effect of {path}", summary["shapley"]["final_gear_speed"]["parameters"][path], share)

    inputs, speeds, summary = sweep(program, 'design = "monte_carlo"\ntrials = 2000',
                                    parameters)
    for k, path in enumerate(PATHS):
        exact = ot.Sample(np.column_stack([inputs[:, k], speeds])).computeSpearmanCorrelation()[0, 1]
        value = next(i["rank_correlation"] for i in summary["influences"] if i["parameter"] == path)
        check(f"rank correlation of {path}: {value:.6f}, OpenTURNS {exact:.6f}", abs(value - exact) < 1e-9)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = str(Path(sys.argv[1]).resolve())
    compare_distributions(program)
    compare_copula(program)
    compare_indices(program)
    print(f"{len(faults)} faults")
    sys.exit(len(faults) > 0)
