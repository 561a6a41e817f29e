"""Experiments of published papers, one module each.

A module has run(seed, seeds, out), which returns what `landfall reproduce PAPER --json` prints and draws
pictures in the folder `out`, and table(result), the rows that a person reads.
"""
