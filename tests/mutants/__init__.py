"""Random changes of the package: does a test notice each of them?"""
