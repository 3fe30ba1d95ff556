PY := .venv/bin/python

.PHONY: run test check numbers scenes loop bench models gallery figures chart maps clean

run: .venv/ready
	$(PY) -m mjsim.run --surface all

test: .venv/ready
	$(PY) -m pytest

# what .ci/run runs after `make test`
check: .venv/ready
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(PY) -m pytest -m slow

numbers: .venv/ready
	$(PY) benchmarks/convergence.py

scenes: .venv/ready
	$(PY) benchmarks/scenes.py

loop: .venv/ready
	$(PY) benchmarks/loop.py

bench: .venv/ready
	$(PY) -m pytest benchmarks --benchmark-only -o addopts="" --benchmark-columns=min,median,rounds

# write models/ anew after a change of the generator or of the default robot
models: .venv/ready
	$(PY) -m mjsim.export

# the seed's figures, as docs/figures.md shows them
figures: .venv/ready
	$(PY) -m mjsim.figures --out docs

# speed against accuracy: what is not yet in mjsim/accuracy/rows.csv, and the figures
chart: .venv/ready
	$(PY) -m mjsim.chart

# where methods fail
maps: .venv/ready
	$(PY) -m mjsim.stability

# the videos and the picture of the README
gallery: .venv/ready
	$(PY) -m mjsim.gallery

.venv/ready: pyproject.toml constraints.txt scripts/setup.sh
	bash scripts/setup.sh
	touch $@

clean:
	rm -rf .venv build dist
