"""Models that share no code with the component; ``README.md`` lists their equations."""
