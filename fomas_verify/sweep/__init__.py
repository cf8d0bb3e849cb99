"""Many designs: a grid of them, decided on all cores or on a Dask cluster, as the rows of a Parquet dataset."""
