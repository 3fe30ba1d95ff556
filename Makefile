PYTHON := .venv/bin/python

.PHONY: run test check numbers bench models gallery clean

run: .venv/ready
	$(PYTHON) -m mjsim.run --surface all

test: .venv/ready
	$(PYTHON) -m pytest

# what .ci/run runs after `make test`
check: .venv/ready
	$(PYTHON) -m ruff check .
	$(PYTHON) -m ruff format --check .
	$(PYTHON) -m mypy
	$(PYTHON) -m pytest -m slow

numbers: .venv/ready
	$(PYTHON) benchmarks/convergence.py

bench: .venv/ready
	$(PYTHON) -m pytest benchmarks --benchmark-only -o addopts="" --benchmark-columns=min,median,rounds

# write models/ anew after a change of the generator or of the default robot
models: .venv/ready
	$(PYTHON) -m mjsim.export

# the videos and the picture of the README
gallery: .venv/ready
	$(PYTHON) -m mjsim.gallery

.venv/ready: pyproject.toml constraints.txt scripts/setup.sh
	bash scripts/setup.sh
	touch $@

clean:
	rm -rf .venv build dist
