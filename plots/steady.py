def draw(r):
    pass
