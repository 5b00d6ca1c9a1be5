"""What all folders use: checks of arguments and paths, values, pickles, CSV cells, remedies of errors."""
