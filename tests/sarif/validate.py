#!/usr/bin/env python3
"""validate.py BINARY SCHEMA PROGRAM...: the SARIF reports of `ncport check` over the programs, one by one and all
together, are valid by the schema of the standard. Says in a line when the schema or python3-jsonschema is not here."""
import json
import os
import subprocess
import sys


def report(binary, programs):
    run = subprocess.run([binary, "check", "--format", "sarif", "--fail-on", "never", *programs],
                         stdout=subprocess.PIPE, timeout=60, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(programs)}: code {run.returncode}")
    return json.loads(run.stdout)


def main():
    binary, schema_path, *programs = sys.argv[1:]
    if not os.path.isfile(schema_path):
        print("skipped: the schema of SARIF is not here (NCPORT_SHARED)")
        return
    try:
        import jsonschema
    except ImportError:
        print("skipped: the package python3-jsonschema is not installed")
        return
    with open(schema_path, encoding="utf-8") as file:
        schema = json.load(file)
    validator = jsonschema.validators.validator_for(schema)(schema)
    results = 0
    for group in [[program] for program in programs] + [programs]:
        sarif = report(binary, group)
        errors = [f"{'/'.join(map(str, error.path))}: {error.message}" for error in validator.iter_errors(sarif)]
        if errors:
            sys.exit(f"{' '.join(group)}: not valid\n" + "\n".join(errors[:10]))
        results += len(sarif["runs"][0]["results"])
    if results == 0:
        sys.exit("no report holds a result, so nothing was shown")
    print(f"{len(programs) + 1} reports with {results} results are valid")


main()
