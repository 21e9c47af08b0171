"""Laws side by side with the exact solution."""

from .error_maps import ErrorMap, error_map
from .one_pair import Comparison, LawAnswer, compare
from .recommendation import Ranked, Recommendation, recommend

__all__ = [
    "Comparison",
    "ErrorMap",
    "LawAnswer",
    "Ranked",
    "Recommendation",
    "compare",
    "error_map",
    "recommend",
]
