#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The scanworld authors
# SPDX-License-Identifier: Apache-2.0
"""Compares two builds: bench/compare.py A B [--rounds N] [arguments for scanworld_bench]

A and B are paths of scanworld_bench, which run in turn, A B A B ... What slows the machine for a while then slows both
of a pair, and their ratio is still right. Told are medians over the rounds: of the times, and of the ratio of each
pair. Without --runs among the arguments each turn makes 3 runs.
"""
import argparse
import json
import statistics
import subprocess
import sys

ROW = '{:<28} {:>9} {:>9} {:>7}  {:>9} {:>9} {:>7}'


def run(program, arguments):
    """What one scanworld_bench measured, a dict for each input."""
    try:
        done = subprocess.run([program, '--json', *arguments], stdout=subprocess.PIPE, check=True)
        return json.loads(done.stdout)['inputs']
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        sys.exit(f'compare.py: {program}: {error}')


def times(place, kind):
    """The times of one measurement [ms], by stage."""
    stages = {stage['name']: 1e3 * stage[kind] for stage in place['stages']}
    return {**stages, 'all': 1e3 * place['all'][kind]}


def columns(stage, a_rounds, b_rounds):
    """The medians of A, of B, and of B/A, as text; '-' where a build has no such stage."""
    a, b = ([r[stage] for r in rounds if stage in r] for rounds in (a_rounds, b_rounds))
    ratios = [y / x for x, y in zip(a, b) if x > 0]
    return [f'{statistics.median(values):.{digits}f}' if values else '-'
            for values, digits in ((a, 2), (b, 2), (ratios, 3))]


def tell(a, b):
    """Prints what two builds, `a` and `b`, measured of one place in all rounds."""
    print(f"{a[0]['input']}: {a[0]['points']} points")
    if a[0]['fingerprint'] != b[0]['fingerprint']:
        print(f"NOT THE SAME POINTS: B has {b[0]['points']} others; the times cannot be compared")
    print(ROW.format('stage', 'A ms', 'B ms', 'B/A', 'A CPU ms', 'B CPU ms', 'B/A'))
    wall, cpu = ([[times(place, kind) for place in rounds] for rounds in (a, b)]
                 for kind in ('seconds', 'cpu_seconds'))
    stages = dict.fromkeys([*wall[0][0], *wall[1][0]])  # in order, those of A first
    stages['all'] = stages.pop('all')
    for stage in stages:
        print(ROW.format(stage, *columns(stage, *wall), *columns(stage, *cpu)))
    hashes = [{place['world_hash'] for place in rounds} for rounds in (a, b)]
    same = hashes[0] == hashes[1] and len(hashes[0]) == 1
    print('world hashes', 'are equal:' if same else 'DIFFER:', *sorted(hashes[0]),
          *([] if same else ['->', *sorted(hashes[1])]))
    if not same and 'score' in a[0] and 'score' in b[0]:
        scores = zip(a[0]['score'].items(), b[0]['score'].values())
        print('score', ', '.join(f'{name} {x:.4g} -> {y:.4g}' for (name, x), y in scores))
    print()


def main():
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[0].split(': ')[1], allow_abbrev=False,
                                     description=__doc__.split('\n\n')[1])
    parser.add_argument('a', metavar='A', help='path of a scanworld_bench')
    parser.add_argument('b', metavar='B', help='path of another')
    parser.add_argument('--rounds', type=int, default=7, metavar='N', help='pairs of runs (7)')
    options, arguments = parser.parse_known_args()
    if options.rounds < 1:
        parser.error('--rounds should be 1 or more')
    if not any(argument.split('=')[0] == '--runs' for argument in arguments):
        arguments = ['--runs', '3', *arguments]
    a, b = [], []
    for _ in range(options.rounds):
        a.append(run(options.a, arguments))
        b.append(run(options.b, arguments))
    for places in zip(zip(*a), zip(*b)):
        tell(*places)


if __name__ == '__main__':
    main()
