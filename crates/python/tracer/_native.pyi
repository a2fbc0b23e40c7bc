"""The compiled part. Its functions are called by the package alone."""

from typing import Any, Dict, List

version: str
layers: List[str]

def load(request: Dict[str, Any]) -> Dict[str, Any]: ...
