"""Run two workers of dask.distributed, each in its own process, until the standard input ends.

It prints the address of the scheduler, then the process id of each worker.
"""

from __future__ import annotations

import sys

from distributed import LocalCluster


def main() -> None:
    """Start the workers and wait."""
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", host="127.0.0.1"
    ) as cluster:
        print(cluster.scheduler_address, flush=True)
        print(*(nanny.pid for nanny in cluster.workers.values()), flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    main()
