"""Sweeps of 10,000 scenes: python crates/python/bench_sweep.py [ROWS]

The same sweep by 2 threads, by 2 workers of Dask, and by these with one killed in the middle and restarted. It tells how
much more time Dask takes, also of the processors, and whether all tables have the same bytes.
"""

import json
import os
import pathlib
import pickle
import signal
import sys
import tempfile
import threading
import time
from typing import Any

from dask.distributed import Client, LocalCluster

import wavestep as ws

ROWS = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
ASKED: dict[str, Any] = {"at": [1, 3], "max": "strain_fixed", "end": 5, "progress": False}


def timed(**options: Any) -> tuple[float, bytes]:
    """Seconds, and the table as bytes."""
    begun = time.perf_counter()
    frame = ws.sweep("mass-on-fixed-bar", {"mu": f"1/4..4:{ROWS}"}, **ASKED, **options)
    took = time.perf_counter() - begun
    assert len(frame) == ROWS and frame["error"].isna().all()
    return took, pickle.dumps(frame.to_dict("list"))


def worked(client: Client) -> float:
    """Seconds of the processors so far, of this process with the scheduler, and of the workers."""
    workers: list[float] = list(client.run(time.process_time).values())
    return time.process_time() + sum(workers)


def kill_in_the_middle(client: Client, folder: pathlib.Path) -> None:
    """Kills the process of a worker once about half of the chunks are done."""
    victim = min(client.run(os.getpid).values())

    def kill() -> None:
        plan = folder / "sweep.json"
        while not plan.exists():
            time.sleep(0.01)
        chunks = len(json.loads(plan.read_text())["ends"])
        while (done := len(list(folder.glob("*.parquet")))) < chunks // 2:
            time.sleep(0.01)
        os.kill(victim, signal.SIGKILL)
        print(f"killed when {done} of {chunks} chunks were done")

    threading.Thread(target=kill).start()


def main() -> None:
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        # In turns, so that other work on the machine delays both.
        own_runs, dask_runs, work = [], [], [worked(client)]
        for _ in range(3):
            own_runs.append(own := timed(threads=2))
            work.append(worked(client))
            dask_runs.append(dask := timed(engine="dask", client=client))
            work.append(worked(client))
            steps = [later - earlier for earlier, later in zip(work[-3:], work[-2:], strict=False)]
            processors = f"time of the processors {steps[1] / steps[0] - 1:+.1%}"
            print(f"2 threads {own[0]:.1f} s, Dask with 2 workers {dask[0]:.1f} s; {processors}")
        own, dask = min(own_runs), min(dask_runs)
        print(f"{ROWS} rows, the fastest runs: Dask takes {dask[0] / own[0] - 1:+.1%}")
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            kill_in_the_middle(client, folder)
            killed = timed(engine="dask", client=client, folder=folder)
            print(f"with one worker killed {killed[0]:.1f} s")
            again = timed(engine="dask", client=client, folder=folder)
            print(f"from the folder alone {again[0]:.2f} s")
    tables = {table for _, table in [*own_runs, *dask_runs, killed, again]}
    print(f"the same bytes: {len(tables) == 1}")


if __name__ == "__main__":
    main()
