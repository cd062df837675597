"""Interior models: layers, Love numbers, hydrostatic figure and free rotational modes."""
