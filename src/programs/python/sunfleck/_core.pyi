# The compiled part. It is internal; the classes around it have the types that users see.
from typing import Any

version: str
commit: str

def __getattr__(name: str) -> Any: ...
